"""What the driver stands between: ROS above, four buses and the inverters below (README, doc/profibus.md and its siblings)."""
from svg import BLUE, GREEN, INK, MUTED, ORANGE, Picture

# Bus, engine, what the computer has, cable, bus modules with how many inverters each: as the documents of the buses say.
COLUMNS = (
    ("PROFIBUS DP", "own DP master", "RS-485 adapter, USB or UART", "RS-485",
     ("SK TU1/2/3-PBR: 1", "SK CU4/TU4-PBR: 1 to 4")),
    ("CANopen", "own CANopen master", "SocketCAN interface", "CAN",
     ("SK TU1/2/3-CAO, own port: 1", "SK CU4/TU4-CAO: 1 to 4")),
    ("DeviceNet", "own scanner", "SocketCAN interface", "CAN and 24 V",
     ("SK CU4-DEV, SK TU4-DEV:", "1 to 4")),
    ("InterBus", "Modbus/TCP client", "gateway, by Ethernet", "InterBus ring",
     ("SK TU1/2/3-IBS: 1",)),
)


def base(picture, x, y, wheels):
    """A base from above, its wheels beside it."""
    picture.box(x, y, 74, 40, (), "driver", radius=6)
    for place in ((24,) if wheels == 2 else (4, 44)):
        picture.bar(x + place, y - 11, 26, 9)
        picture.bar(x + place, y + 42, 26, 9)


def draw():
    picture = Picture("driver_overview", 700, "nord_driver between ROS and NORD inverters",
                      "ROS nodes send cmd_vel and call services of nord_driver_node, which publishes odometry, joint states, status "
                      "and diagnostics. Below it one of four transports speaks PROFIBUS DP, CANopen, DeviceNet or InterBus with the "
                      "bus modules of NORD frequency inverters, which turn the wheels.")
    picture.box(24, 20, 952, 50, ("Your robot in ROS: navigation, teleoperation, monitoring, rviz",), "ros", 15)

    down, up = BLUE, GREEN
    for x, label, colour, arrow in ((150, "cmd_vel", down, "end"), (340, "services", down, "end"),
                                    (560, "odom, tf, joint_states", up, "start"), (790, "status, /diagnostics", up, "start")):
        picture.line([(x, 70), (x, 132)], colour, 2.4, arrow)
        picture.text(x + 10, 97, label, 14, bold=True, colour=colour)
    picture.text(350, 116, "enable, quick_stop, ...", 13, colour=MUTED)
    picture.text(160, 116, "m/s, rad/s", 13, colour=MUTED)

    picture.box(24, 132, 952, 176, (), "driver")
    picture.text(40, 156, "nord_driver_node", 16, bold=True, colour=GREEN)
    picture.text(216, 156, "one bus cycle, usually 100 times a second; a node has one of the four transports below", 13, colour=MUTED)
    picture.box(40, 168, 300, 52, ("Base", "limits, wheel kinematics, odometry"), "plain", 13)
    picture.box(356, 168, 300, 52, ("Drives", "enable, stops, faults, parameters"), "plain", 13)
    picture.box(672, 168, 288, 52, ("Profile", "control word, status word, scaling"), "plain", 13)

    for number, (bus, engine, link, cable, modules) in enumerate(COLUMNS):
        left = 40 + 232 * number
        middle = left + 112
        picture.box(left, 236, 224, 56, (bus, engine), "bus", 14)
        picture.line([(middle, 292), (middle, 326)], ORANGE, 3)
        picture.box(left, 326, 224, 34, (link,), "plain", 13, title=False)
        picture.line([(middle, 360), (middle, 404)], ORANGE, 3)
        picture.text(middle + 10, 387, cable, 13, bold=True, colour=ORANGE)
        picture.box(left, 404, 224, 66, ("Bus module: inverters", *modules), "device", 13)
        picture.line([(middle, 470), (middle, 496)], MUTED, 3)

    picture.box(24, 496, 952, 56, ("NORD frequency inverters and their motors",
                                   "SK 1x0E, SK 2xxE, SK 300E, SK 5xxE, SK 54xE, SK 700E, SK 750E"), "device", 14)
    picture.line([(500, 552), (500, 578)], MUTED, 3, "end")
    picture.box(24, 578, 952, 102, (), "group")
    for left, wheels, label in ((108, 2, "differential"), (345, 4, "skid steer"), (582, 4, "mecanum")):
        base(picture, left, 604, wheels)
        picture.text(left + 37, 671, label, 13, "middle")
    picture.box(806, 604, 100, 40, (), "driver", radius=20)
    for x in (825, 856, 887):
        picture.circle(x, 624, 10, "#ffffff", INK)
    picture.text(856, 671, "drives without a base", 13, "middle")
    return picture
