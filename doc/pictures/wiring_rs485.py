"""PROFIBUS DP on RS-485: a line, terminated at both ends (EN 50170; BU 0020 2.1 to 2.3 and 4, BU 0220 2.2.2, BU 2700 3.2)."""
from svg import GREEN, MUTED, ORANGE, RED, Picture

B_LINE, A_LINE, SHIELD = 190, 214, 238
# Left edge, lines, kind, place of the terminator at an end.
STATIONS = (
    (24, ("Computer", "RS-485 adapter:", "one end"), "driver", 38),
    (284, ("Bus module", "address 3"), "device", None),
    (544, ("Bus module", "address 4"), "device", None),
    (804, ("Bus module", "the other end,", "always powered"), "device", 940),
)
TABLE = (
    ("Signal", "SUB-D9", "M12 (B-coded)", "SK TU2-PBR-KL", "SK CU4-PBR", "SK TU4-PBR"),
    ("", "SK TU1/TU3-PBR", "SK TU2-PBR", "terminals", "terminals", "on SK TI4-TU-BUS"),
    ("B, red", "3", "4", "4, 7", "82", "3 in, 4 out"),
    ("A, green", "8", "2", "3, 6", "81", "5 in, 6 out"),
    ("GND", "5", "3", "2", "46", "7, 8"),
    ("+5 V", "6", "1", "1", "47 *", "10 *"),
    ("Shield", "1 and housing", "thread", "8", "cable gland", "cable gland"),
    ("Terminator", "switch in plug", "a plug of its own", "2 micro-switches", "2 DIP PB Term.", "2 DIP PB Term."),
)


def station(picture, left, lines, kind, terminated_at):
    picture.box(left, 62, 172, 76, lines, kind, 13)
    for x, y, colour in ((left + 40, B_LINE, RED), (left + 66, A_LINE, GREEN)):
        picture.line([(x, 138), (x, y)], colour, 2.6)
        picture.dot(x, y, colour)
    if terminated_at:
        picture.resistor(terminated_at, B_LINE, A_LINE, "", colour=ORANGE)
    picture.text(left + 88, 48, "terminator on" if terminated_at else "terminator off", 14, "middle", bold=True,
                 colour=ORANGE if terminated_at else MUTED)


def terminator(picture, x, top):
    """The resistors, with the pins of the SUB-D9 plug."""
    picture.text(x - 24, top + 6, "+5 V, pin 6", 13, "end", bold=True, colour=ORANGE)
    picture.text(x - 24, top + 66, "B, pin 3", 13, "end", bold=True, colour=RED)
    picture.text(x - 24, top + 126, "A, pin 8", 13, "end", bold=True, colour=GREEN)
    picture.text(x - 24, top + 186, "GND, pin 5", 13, "end", bold=True)
    for y, value in ((0, "390 ohm"), (60, "220 ohm"), (120, "390 ohm")):
        picture.resistor(x, top + y, top + y + 60, value)
    for y, colour in ((0, ORANGE), (60, RED), (120, GREEN), (180, MUTED)):
        picture.line([(x - 18, top + y), (x, top + y)], colour, 2.6)
        picture.dot(x, top + y, colour)


def draw():
    picture = Picture("wiring_rs485", 760, "PROFIBUS wiring with termination",
                      "A line of stations on two wires, B (red) and A (green), with a shield that is earthed at both ends. The "
                      "terminators are switched on at the first and the last station only. A terminator is 390 ohm from +5 V "
                      "(pin 6) to B (pin 3), 220 ohm from B to A (pin 8), and 390 ohm from A to ground (pin 5).")
    for left, lines, kind, terminated_at in STATIONS:
        station(picture, left, lines, kind, terminated_at)
    picture.line([(38, B_LINE), (940, B_LINE)], RED, 3)
    picture.line([(38, A_LINE), (940, A_LINE)], GREEN, 3)
    picture.line([(64, SHIELD), (924, SHIELD)], MUTED, 2, dash="7 5")
    for x in (64, 924):
        picture.earth(x, SHIELD)
    picture.text(480, B_LINE - 8, "B, red", 13, "middle", bold=True, colour=RED)
    picture.text(500, SHIELD + 20, "shield: at both ends, large area, on functional earth", 13, "middle", colour=MUTED)
    picture.text(748, A_LINE + 17, "A, green", 13, "middle", bold=True, colour=GREEN)

    picture.box(24, 286, 330, 236, (), "group")
    picture.text(40, 310, "The terminator (SUB-D9 plug)", 15, bold=True)
    terminator(picture, 200, 324)

    picture.box(370, 286, 606, 236, (), "group")
    picture.text(386, 310, "Rules", 15, bold=True)
    picture.lines(386, 334, (
        "On at both ends of the line, off everywhere else.",
        "It needs 5 V all the time: idle, B must be more positive than A. At the adapter's",
        "end use an active terminator, or a plug fed with 5 V.",
        "120 ohm alone ends the line, but leaves it floating while nobody sends.",
        "Two wires, twisted, shielded (type A); a line, no branches; at most 32 stations.",
        "9.6 to 93.75 kbit/s: 1200 m; 187.5: 1000 m; 500: 400 m; 1500: 200 m; more: 100 m.",
        "At least 1 m of cable between stations, 20 cm away from cables above 60 V.",
        "Adapters name A and B as they like. No station answers? Exchange the two wires.",
    ), 13, 22)

    bottom = picture.table(24, 538, (96, 170, 166, 174, 160, 186), TABLE, 13, 23, 2)
    picture.text(24, bottom + 18, "* not for use outside the module (BU 0220 2.2.2). SUB-D9 also: 4 = RTS. "
                 "SK TU2-PBR-KL: 5 = RTS. SK CU4-PBR: 83 = RTS. SK TU4-PBR: 9 = RTS.", 12, colour=MUTED)
    return picture
