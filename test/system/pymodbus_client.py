#!/usr/bin/python3
"""An independent Modbus/TCP client (pymodbus) for the test of the simulated gateway.

Usage: pymodbus_client.py PORT REQUEST...   with REQUEST one of
    input:FIRST:COUNT    holding:FIRST:COUNT    write:FIRST:WORD,WORD,...    both:FIRST:COUNT:WRITE_FIRST:WORD,...
Words are hexadecimal, also in what is printed: a line per request, the registers or "exception N". Ends with 77 when
there is no pymodbus, or one before 3.0.
"""
import sys

try:
    from pymodbus.client import ModbusTcpClient
except ImportError:
    sys.exit(77)


def words(text):
    return [int(word, 16) for word in text.split(",")]


def ask(client, request):
    kind, *arguments = request.split(":")
    if kind == "input":
        return client.read_input_registers(int(arguments[0]), int(arguments[1]), slave=1)
    if kind == "holding":
        return client.read_holding_registers(int(arguments[0]), int(arguments[1]), slave=1)
    if kind == "write":
        return client.write_registers(int(arguments[0]), words(arguments[1]), slave=1)
    # This one hands its arguments to the request itself, which calls the unit so.
    return client.readwrite_registers(read_address=int(arguments[0]), read_count=int(arguments[1]),
                                      write_address=int(arguments[2]), write_registers=words(arguments[3]), unit=1)


def main():
    client = ModbusTcpClient("127.0.0.1", port=int(sys.argv[1]))
    client.connect()
    for request in sys.argv[2:]:
        answer = ask(client, request)
        if answer.isError():
            print("exception", answer.exception_code)
        else:
            print(" ".join(f"{word:04X}" for word in getattr(answer, "registers", None) or []) or "written")
    client.close()


main()
