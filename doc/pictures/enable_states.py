"""Enable, stops, fault and acknowledgement of a base or a single drive (src/drive: Drive, DriveGroup; doc/safety.md, services.md)."""
from svg import BLUE, GREEN, INK, MUTED, ORANGE, RED, Picture

# Left edge, top, width, height, lines, kind. The second line is the control word in parameter set 1.
STATES = (
    (24, 60, 226, 116, ("On the wire", "047E: OFF1, and the idle word", "047F: run to setpoint 1", "047B: OFF3, quick stop",
                        "bits 14, 15: parameter set"), "plain"),
    (370, 60, 240, 90, ("Enabling", "047E, then 047F", "until every drive confirms"), "driver"),
    (740, 60, 236, 90, ("Enabled", "047F and setpoint 1, follows", "commands; too old: setpoint 0"), "driver"),
    (24, 270, 210, 90, ("Offline", "0000 before any answer,", "the stop word after a loss"), "device"),
    (370, 270, 240, 90, ("Disabled", "047E, the idle word", "no torque, waits for ~enable"), "ros"),
    (740, 270, 236, 90, ("Ramping down", "047F to setpoint 0, then 047E", "until \"ready to switch on\""), "bus"),
    (24, 490, 230, 100, ("Fault latched", "047E, disabled", "~enable is refused,", "even if the fault bit is gone"), "stop"),
    (370, 490, 240, 100, ("Quick stop", "047B", "until \"switch-on disabled\""), "bus"),
    (740, 490, 236, 100, ("Halted", "the drive that stopped: 047E", "the others: setpoint 0 down", "their own ramp, then 047E"), "bus"),
)


def draw():
    picture = Picture("enable_states", 690, "Enable, stops, fault and acknowledgement",
                      "A drive or base is offline, disabled, enabling, enabled, ramping down, in quick stop or halted. Only the "
                      "service enable leads from disabled to enabled. A fault is latched until acknowledge_faults, and leads back "
                      "to disabled, never to enabled.")
    picture.text(24, 36, "From power on to driving, and back", 16, bold=True)
    picture.text(976, 36, "a base stands or falls as a whole; a drive without base is a base of one", 13, "end", colour=MUTED)
    for left, top, width, height, lines, kind in STATES:
        picture.box(left, top, width, height, lines, kind, 13)

    picture.line([(234, 300), (370, 300)], BLUE, 2.4, "end")
    picture.text(302, 291, "status word", 13, "middle", bold=True)
    picture.line([(370, 330), (234, 330)], MUTED, 2.4, "end")
    picture.text(302, 348, "drive_timeout", 13, "middle", bold=True)
    picture.text(302, 366, "from any state", 12, "middle", colour=MUTED)

    picture.line([(450, 270), (450, 150)], GREEN, 3, "end")
    picture.text(440, 182, "~enable true", 14, "end", bold=True, colour=GREEN)
    picture.lines(440, 203, ("refused: fault, absent drive,", "local control, cmd_vel not zero,", "P105 not known, P104 > 0"), 12, 17,
                  anchor="end", colour=MUTED)
    picture.line([(530, 150), (530, 270)], MUTED, 2.4, "end")
    picture.lines(540, 196, ("not within service_timeout,", "or a stop came first"), 13, 18, colour=INK)
    picture.line([(610, 105), (740, 105)], GREEN, 3, "end")
    picture.text(672, 96, "\"operation", 13, "middle")
    picture.text(672, 122, "enabled\"", 13, "middle")

    picture.line([(850, 150), (850, 270)], BLUE, 2.4, "end")
    picture.text(860, 202, "~enable false,", 13, bold=True)
    picture.text(860, 220, "end of node", 13)
    picture.line([(740, 300), (610, 300)], BLUE, 2.4, "end")
    picture.text(676, 291, "at rest", 13, "middle")

    picture.line([(530, 490), (530, 360)], BLUE, 2.4, "end")
    picture.text(540, 430, "at rest", 13)
    picture.line([(850, 490), (850, 425), (660, 425), (660, 335), (610, 335)], BLUE, 2.4, "end")
    picture.text(755, 416, "at rest, cause kept", 13, "middle")
    picture.line([(480, 360), (480, 450), (312, 450), (312, 540), (254, 540)], RED, 2.4, "end")
    picture.text(400, 443, "fault bit seen", 13, "middle", bold=True, colour=RED)
    picture.line([(140, 490), (140, 408), (430, 408), (430, 360)], GREEN, 2.4, "end")
    picture.text(150, 401, "~acknowledge_faults", 13, bold=True, colour=GREEN)
    picture.text(150, 426, "cause gone (bit 7, 04FE)", 13, colour=MUTED)

    for x, lines, colour in ((490, ("~quick_stop, from any state;", "a ramp longer than shutdown_timeout, 10 s"), ORANGE),
                             (860, ("enabled, and a drive has a fault,", "is silent, or is stopped by terminals"), RED)):
        picture.line([(x, 622), (x, 590)], colour, 2.4, "end")
        picture.lines(x if x < 800 else 850, 640, lines, 13, 18, anchor="middle")
    picture.lines(139, 622, ("cause stands: refused,", "stays here. Nothing moves", "by acknowledging."), 13, 18, anchor="middle", colour=MUTED)
    return picture
