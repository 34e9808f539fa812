"""CAN: a line with 120 ohm at both ends, and what DeviceNet adds (ISO 11898-2, CiA 303-1; BU 0280 2.2.2 and 2.2.3; BU 2700 4.1)."""
from svg import BLUE, INK, MUTED, ORANGE, RED, Picture

HIGH, LOW, GROUND, SHIELD = 190, 214, 238, 262
STATIONS = (
    (24, ("Computer", "CAN interface:", "one end"), "driver", 38),
    (284, ("Inverter or module", "its own id"), "device", None),
    (544, ("Inverter or module", "its own id"), "device", None),
    (804, ("Inverter or module", "the other end"), "device", 940),
)
TABLE = (
    ("Signal", "SUB-D9", "DeviceNet cable", "SK CU4-DEV", "SK TU4-DEV on SK TI4-TU-BUS"),
    ("", "CiA 303-1", "", "terminals (BU 0280 2.2.2.1)", "terminals (BU 0280 2.2.2.2)"),
    ("CAN_H", "7", "white", "75 (DVN +)", "3 in, 4 out (DVN +)"),
    ("CAN_L", "2", "blue", "76 (DVN -)", "5 in, 6 out (DVN -)"),
    ("GND, V-", "3", "black", "46 (GND BUS)", "7, 8 (GND BUS)"),
    ("24 V, V+", "9, if at all", "red", "45 (24 V BUS)", "1, 2 (24 V BUS)"),
    ("Shield", "5 and housing", "bare", "90 (SHLD)", "9 (SHLD); 10 is PE"),
)


def station(picture, left, lines, kind, terminated_at):
    picture.box(left, 62, 172, 76, lines, kind, 13)
    for x, y, colour in ((left + 40, HIGH, ORANGE), (left + 66, LOW, BLUE), (left + 92, GROUND, INK)):
        picture.line([(x, 138), (x, y)], colour, 2.6)
        picture.dot(x, y, colour)
    if terminated_at:
        picture.resistor(terminated_at, HIGH, LOW)
    picture.text(left + 86, 48, "120 ohm" if terminated_at else "no resistor", 14, "middle", bold=True,
                 colour=INK if terminated_at else MUTED)


def devicenet(picture, left, top):
    """Where the 24 V come from; the data wires are those of CAN."""
    picture.box(left, top, 466, 216, (), "group")
    picture.text(left + 16, top + 24, "DeviceNet: the cable also carries 24 V", 15, bold=True)
    picture.box(left + 16, top + 40, 110, 64, ("24 V supply", "of the bus"), "bus", 13)
    picture.box(left + 320, top + 40, 130, 64, ("Module", "SK CU4-DEV"), "device", 13)
    for y, label, colour in ((top + 56, "V+, red, to terminal 45", RED), (top + 92, "V-, black, to terminal 46", INK)):
        picture.line([(left + 126, y), (left + 320, y)], colour, 2.6)
        picture.text(left + 223, y - 6, label, 13, "middle", bold=True, colour=colour)
    picture.lines(left + 16, top + 128, (
        "The bus side of a module is fed by the cable: it stays on the",
        "bus when the inverter is off. Without 24 V nothing answers.",
        "The computer's interface needs CAN_H, CAN_L and V- (as",
        "CAN_GND); V+ only where its data sheet asks for it.",
    ), 13, 22)


def draw():
    picture = Picture("wiring_can", 720, "CAN wiring with termination",
                      "A line of stations on CAN_H, CAN_L and CAN_GND with a shield. A resistor of 120 ohm lies between CAN_H and "
                      "CAN_L at both ends of the line and nowhere else. DeviceNet adds 24 V in the same cable, which feed the bus "
                      "side of the modules.")
    for each in STATIONS:
        station(picture, *each)
    picture.line([(38, HIGH), (940, HIGH)], ORANGE, 3)
    picture.line([(38, LOW), (940, LOW)], BLUE, 3)
    picture.line([(116, GROUND), (896, GROUND)], INK, 3)
    picture.line([(64, SHIELD), (896, SHIELD)], MUTED, 2, dash="7 5")
    picture.earth(64, SHIELD)
    for x, y, label, colour in ((500, HIGH - 7, "CAN_H", ORANGE), (480, GROUND - 7, "CAN_GND", INK)):
        picture.text(x, y, label, 13, "middle", bold=True, colour=colour, halo=y > HIGH)
    picture.text(748, LOW - 7, "CAN_L", 13, "middle", bold=True, colour=BLUE)
    picture.text(500, SHIELD + 21, "shield: on functional earth, as the inverter's manual says", 13, "middle", colour=MUTED)

    picture.box(24, 306, 470, 216, (), "group")
    picture.text(40, 330, "Rules", 15, bold=True)
    picture.lines(40, 354, (
        "120 ohm from CAN_H to CAN_L at both ends, nowhere else.",
        "Check with all power off: 60 ohm between CAN_H and CAN_L.",
        "One twisted pair for CAN_H and CAN_L; a line, short branches.",
        "One bit rate for all: P514, rotary or DIP switches, ip link.",
        "125 kbit/s: 500 m; 250: 250 m; 500: 100 m.",
        "SK 511E and above: its CAN port needs 24 V from outside.",
        "SK CU4-DEV, TU4-DEV: their switch ends the system bus only.",
    ), 13, 23)
    devicenet(picture, 510, 306)
    bottom = picture.table(24, 538, (110, 150, 172, 250, 270), TABLE, 13, 22, 2)
    picture.text(24, bottom + 18, "SK TU1/2/3-CAO, SK CU4/TU4-CAO, SK 5xxE's own port: terminals, pins and switches are in their "
                 "own manuals.", 12, colour=MUTED)
    return picture
