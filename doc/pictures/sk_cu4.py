"""One SK CU4-PBR with four inverters on the system bus (BU 0220 2.2.2, 2.2.3, 4.2, 8.4; BU 2700 4.1, 5.3, 8.1; BU 0200 p. 291)."""
from svg import BLUE, GREEN, INK, MUTED, ORANGE, RED, Picture

# Name, address on the system bus, DIP switches 2 and 1 of the inverter, name of the drive in config/sk_cu4.yaml.
INVERTERS = (
    ("FI 1", "32", "off, off", "front_left"),
    ("FI 2", "34", "off, on", "front_right"),
    ("FI 3", "36", "on, off", "rear_left"),
    ("FI 4", "38", "on, on", "rear_right"),
)
HIGH, LOW = 232, 256


def tap(picture, x, y):
    """A participant's connection to both wires of the system bus, from height y."""
    for place, wire, colour in ((x, HIGH, ORANGE), (x + 26, LOW, BLUE)):
        picture.line([(place, y), (place, wire)], colour, 2.6)
        picture.dot(place, wire, colour)


def inverter(picture, number, name, address, switches, drive):
    left = 24 + 244 * number
    picture.box(left, 306, 220, 124, (f"{name}: SK 200E and motor", f"system bus address {address}", f"DIP 2, 1: {switches}",
                                      f"inverter: {number + 1}", drive), "device", 13, mono=(3, 4))
    tap(picture, left + 97, 306)
    on = number == 3
    picture.text(left + 110, 450, "terminator on" if on else "terminator off", 13, "middle", bold=True, colour=INK if on else MUTED)


def draw():
    picture = Picture("sk_cu4", 668, "Four inverters behind one bus module SK CU4-PBR",
                      "The computer reaches one bus module SK CU4-PBR over PROFIBUS. The module is connected to four inverters by "
                      "the system bus, a CAN bus at 250 kbit/s, on which the inverters have the addresses 32, 34, 36 and 38. The "
                      "first and the last participant of the system bus have its terminator switched on.")
    picture.box(24, 24, 372, 150, ("Bus module SK CU4-PBR (or SK TU4-PBR)", "one station of PROFIBUS, ident number 0BA8h",
                                   "address 3 to 125 by DIP switches", "own 24 V at 44 (24 V) and 40 (GND): it answers",
                                   "while inverters are off", "one bus module on a system bus"), "bus", 13)
    for y, colour in ((80, RED), (104, GREEN)):
        picture.line([(396, y), (550, y)], colour, 3)
    picture.text(473, 70, "PROFIBUS, B: 82", 13, "middle", bold=True, colour=RED)
    picture.text(473, 122, "A: 81", 13, "middle", bold=True, colour=GREEN)
    picture.box(550, 44, 170, 100, ("Computer", "nord_driver:", "the DP master"), "driver", 13)
    picture.box(736, 24, 240, 150, ("The module has", "one address, one watchdog,", "one P151 for all four,", "one I/O byte in slot 1,",
                                    "slots 2 to 5 for FI 1 to 4,", "records 100 (own), 101 to 104"), "plain", 13)

    for wire, colour in ((HIGH, ORANGE), (LOW, BLUE)):
        picture.line([(40, wire), (960, wire)], colour, 3)
    tap(picture, 80, 174)
    picture.resistor(40, HIGH, LOW)
    picture.resistor(960, HIGH, LOW)
    picture.text(124, 196, "terminator on", 13, bold=True)
    picture.text(250, 222, "Sys + (77)", 13, bold=True, colour=ORANGE)
    picture.text(345, 276, "Sys - (78)", 13, "end", bold=True, colour=BLUE)
    picture.text(976, 208, "system bus: CAN, 250 kbit/s, 120 ohm at its two ends and nowhere else", 13, "end", colour=MUTED)
    for number, each in enumerate(INVERTERS):
        inverter(picture, number, *each)

    picture.box(24, 468, 464, 180, (), "group")
    picture.text(40, 492, "In every inverter", 15, bold=True)
    picture.lines(40, 518, (
        "P509 = 3: control by the system bus",
        "P546 [-01] = 1, P543 [-01] = 1: frequencies",
        "P120 = 1 or 2: watches the way to the module",
        "P514 = 5: 250 kbit/s; one address each, never the same",
        "SK 1x0E, SK 2xxE: up to four; SK 5xxE, SK 54xE: one",
    ), 13, 25)
    picture.box(504, 468, 472, 180, (), "stop")
    picture.text(520, 492, "What stops the motors (they coast)", 15, bold=True, colour=RED)
    picture.lines(520, 518, (
        "computer dead: watchdog, E10.2 in all four",
        "no valid control word for P151 (> 0): E10.3 in all four",
        "way to one inverter broken: E10.8 or E10.9 in that one",
        "After a time-out the module waits until every one of the",
        "four is acknowledged: call ~acknowledge_faults.",
    ), 13, 25)
    return picture
