#!/usr/bin/python3
"""An independent Modbus/TCP server (pymodbus) for the test of our link.

Prints its port. Input register i holds 1000 + i, holding register i holds 2000 + i until it is written. Ends when its
standard input is closed. Ends with 77 when there is no pymodbus, or one before 3.0.
"""
import asyncio
import logging
import sys

try:
    from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
    from pymodbus.server.async_io import ModbusTcpServer
except ImportError:
    sys.exit(77)


async def main():
    logging.disable(logging.CRITICAL)
    unit = ModbusSlaveContext(ir=ModbusSequentialDataBlock(0, [1000 + i for i in range(300)]),
                              hr=ModbusSequentialDataBlock(0, [2000 + i for i in range(300)]), zero_mode=True)
    server = ModbusTcpServer(ModbusServerContext(slaves={3: unit}, single=False), address=("127.0.0.1", 0))
    serving = asyncio.ensure_future(server.serve_forever())
    await server.serving
    print(server.server.sockets[0].getsockname()[1], flush=True)
    await asyncio.get_running_loop().run_in_executor(None, sys.stdin.read)
    serving.cancel()


asyncio.run(main())
