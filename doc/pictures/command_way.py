"""The way of a command, and who acts when it stops coming (doc/follow_a_cmd_vel.md, doc/safety.md, src/cycle, src/drive)."""
from svg import BLUE, GREEN, MUTED, ORANGE, RED, Picture

LEFT, WIDTH, RIGHT, RIGHT_WIDTH = 24, 370, 436, 540

# Kind, height, lines of the stage; kind and lines of what acts there when nothing comes any more.
STAGES = (
    ("ros", 54, ("cmd_vel", "navigation, teleoperation: m/s, rad/s"), None, ()),
    ("driver", 54, ("Node: takeCommand", "stamps the time; newest value, nobody waits"),
     "driver", ("NaN or infinity", "ignored and counted: the time of the command before runs on")),
    ("driver", 76, ("Bus cycle, 100 Hz: limiter, kinematics", "acceleration limits, curvature kept;", "m/s to rad/s at each wheel"),
     "driver", ("cmd_vel_timeout, 0.5 s", "the base: down its deceleration limit to zero, stays enabled",
                "(stop/command_timeout: or OFF1, quick stop, coast)")),
    ("driver", 94, ("Drive", "047F while enabled, else the idle word 047E;", "zeros are no stop: a NORD drive ignores them"),
     "driver", ("drive_timeout, 3 cycles, at least 0.05 s", "no status word: this drive is offline, it is sent its stop word;",
                "the others: down their ramp, OFF1; latched until ~enable", "shutdown_timeout, 10 s: OFF1 becomes quick stop")),
    ("driver", 54, ("Profile", "rad/s to Hz to a share of P105: 4000h = 100 %"), None, ()),
    ("bus", 76, ("Transport: cyclic exchange", "the words of all drives, once per cycle;", "engine, link, adapter"),
     "bus", ("No answer", "PROFIBUS: slot time, 1 repetition, counted; CAN: answer_window;", "the cycle goes on, drive_timeout decides")),
    ("device", 98, ("Bus module", "passes the words on to the inverter"),
     "stop", ("Computer dead: the module's own time-out, motor coasts", "PROFIBUS: bus/watchdog, 0.2 s: E10.2; CANopen: guarding, 0.3 s: E10.0",
              "DeviceNet: 4 x packet rate, 0.1 s: E10.2; InterBus: gateway and P513",
              "no valid control word: P151 (SK CU4, TU4), P513 (SK TU3): E10.3")),
    ("device", 76, ("Inverter", "setpoint 1 by its ramps P102 and P103", "to the motor"),
     "stop", ("Way between module and inverter broken, motor coasts", "SK 1x0E, 2xxE, 54xE behind SK CU4, TU4: P120: E10.8, E10.9",
              "SK 511E to 535E behind SK CU4, TU4: P513 > 0: E10")),
)
GAP = 22
COLOURS = {"driver": GREEN, "bus": ORANGE, "stop": RED}


def draw():
    height = 92 + sum(stage[1] + GAP for stage in STAGES) + 26
    picture = Picture("command_way", height, "The way of a command, with the time-out at each stage",
                      "From cmd_vel through node, limiter, kinematics, drive, profile and cyclic exchange to the bus module and the "
                      "inverter. Beside each stage stands which time-out acts there, after how long, and what it does.")
    picture.text(LEFT + WIDTH / 2, 36, "The way of a command", 16, "middle", bold=True)
    picture.text(RIGHT + RIGHT_WIDTH / 2, 36, "Nothing comes any more: who acts, after how long", 16, "middle", bold=True)
    picture.text(RIGHT, 62, "driver: a ramp with torque", 13, bold=True, colour=GREEN)
    picture.text(RIGHT + RIGHT_WIDTH, 62, "module, inverter: it coasts", 13, "end", bold=True, colour=RED)
    top = 80
    for number, (kind, tall, lines, acts, answer) in enumerate(STAGES):
        picture.box(LEFT, top, WIDTH, tall, lines, kind, 13)
        if acts:
            picture.line([(LEFT + WIDTH, top + tall / 2), (RIGHT, top + tall / 2)], COLOURS[acts], 2, "end", "5 4")
            picture.box(RIGHT, top, RIGHT_WIDTH, tall, answer, acts, 13, align="start")
        top += tall
        if number + 1 < len(STAGES):
            wire = number == 5
            picture.line([(LEFT + WIDTH / 2, top), (LEFT + WIDTH / 2, top + GAP)], ORANGE if wire else BLUE, 3, "end")
            if wire:
                picture.text(LEFT + WIDTH / 2 + 14, top + 15, "the wire", 13, bold=True, colour=ORANGE)
        top += GAP
    picture.text(LEFT, top + 14, "Times are the defaults. Status words, odometry and faults take the same way back, up to the topics.", 13,
                 colour=MUTED)
    return picture
