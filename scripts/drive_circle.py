#!/usr/bin/python3
"""Drives the demo's steered robot (demo.launch robot:=steered) along a circle by cmd_vel, and to the side and back.

Ends with 0 when the robot's true pose, which only the simulator knows, is back at the start, within 2 cm or --tolerance.
"""

import argparse
import math
import sys

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from nord_driver.msg import DriveStatus
from std_srvs.srv import SetBool

DRIVES = ("front", "rear", "front_steering", "rear_steering")


class Newest:
    """The newest message of a topic."""

    def __init__(self, topic, kind):
        self.message = None
        rospy.Subscriber(topic, kind, self._take, queue_size=1)

    def _take(self, message):
        self.message = message


def heading_of(odometry):
    q = odometry.pose.pose.orientation
    return math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))


def wait_for(what, limit, good):
    deadline = rospy.Time.now() + rospy.Duration(limit)
    while not good():
        if rospy.is_shutdown() or rospy.Time.now() > deadline:
            raise TimeoutError("%s: not after %.0f s" % (what, limit))
        rospy.sleep(0.02)


class CircleDriver:
    def __init__(self, options):
        self._options = options
        self._drives = {name: Newest("/nord_driver/%s/status" % name, DriveStatus) for name in DRIVES}
        self._odom = Newest("/odom", Odometry)
        self._truth = Newest("/nord_sim/truth/odom", Odometry)
        self._command = rospy.Publisher("/cmd_vel", Twist, queue_size=1)

    def run(self):
        sources = list(self._drives.values()) + [self._odom, self._truth]
        wait_for("status of all drives and odometry", 30.0, lambda: all(source.message for source in sources))
        wait_for("all drives online", 30.0, lambda: all(d.message.online for d in self._drives.values()))
        start = self._truth.message.pose.pose.position
        self._enable()
        wait_for("all drives enabled", 10.0, lambda: all(d.message.operation_enabled for d in self._drives.values()))
        self._circle()
        # Out to the left and back: the wheels are steered by a quarter of a turn at standstill first.
        self._sideways(0.4)
        self._sideways(-0.4)
        self._enable(False)
        end = self._truth.message.pose.pose.position
        told = self._odom.message.pose.pose.position
        error = math.hypot(end.x - start.x, end.y - start.y)
        print("The true pose is %.1f cm from the start (%.0f cm allowed), %.1f cm from where odometry has it." %
              (100.0 * error, 100.0 * self._options.tolerance, 100.0 * math.hypot(end.x - told.x, end.y - told.y)))
        return error <= self._options.tolerance

    def _enable(self, on=True):
        """Refused for a moment after the drives have answered: the parameters that decide motion are being read."""
        rospy.wait_for_service("/nord_driver/enable", 10.0)
        enable = rospy.ServiceProxy("/nord_driver/enable", SetBool)
        deadline = rospy.Time.now() + rospy.Duration(15.0)
        answer = enable(on)
        while not answer.success and rospy.Time.now() < deadline and not rospy.is_shutdown():
            rospy.sleep(0.2)
            answer = enable(on)
        print("-- ~enable %s: %s" % (str(on).lower(), answer.message))
        if not answer.success:
            raise RuntimeError("~enable %s was refused: %s" % (str(on).lower(), answer.message))

    def _send(self, forward, turning, left):
        if not all(drive.message.operation_enabled for drive in self._drives.values()):
            raise RuntimeError("the base has stopped by itself: see /diagnostics. On a busy computer the simulator may have "
                               "been too late: try again")
        twist = Twist()
        twist.linear.x, twist.angular.z, twist.linear.y = forward, turning, left
        self._command.publish(twist)
        rospy.sleep(0.02)

    def _approach(self, what, rest, command):
        deadline = rospy.Time.now() + rospy.Duration(90.0)
        while rest() > 0.003:
            if rospy.is_shutdown() or rospy.Time.now() > deadline:
                raise TimeoutError("%s: %.3f left" % (what, rest()))
            command(max(0.1, min(1.0, 2.0 * rest())))
        while any(abs(drive.message.frequency) > 0.05 for drive in self._drives.values()):
            self._send(0.0, 0.0, 0.0)
        for _ in range(20):
            self._send(0.0, 0.0, 0.0)

    def _circle(self):
        print("-- a circle of %.1f m radius" % self._options.radius)
        state = {"last": heading_of(self._odom.message), "turned": 0.0}

        def rest():
            now = heading_of(self._odom.message)
            state["turned"] += math.remainder(now - state["last"], 2.0 * math.pi)
            state["last"] = now
            return 2.0 * math.pi - state["turned"]

        speed = self._options.speed
        self._approach("the circle", rest,
                       lambda part: self._send(part * speed, part * speed / self._options.radius, 0.0))

    def _sideways(self, distance):
        print("-- %.1f m to the left" % distance)
        start = self._odom.message

        def rest():
            now, was, heading = self._odom.message.pose.pose.position, start.pose.pose.position, heading_of(start)
            gone = -(now.x - was.x) * math.sin(heading) + (now.y - was.y) * math.cos(heading)
            return abs(distance) - math.copysign(1.0, distance) * gone

        self._approach("the way to the side", rest,
                       lambda part: self._send(0.0, 0.0, math.copysign(part * 0.3, distance)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--radius", type=float, default=1.0, help="of the circle in m")
    parser.add_argument("--speed", type=float, default=0.4, help="top speed in m/s")
    parser.add_argument("--tolerance", type=float, default=0.02, help="how far from the start it may end, in m")
    options = parser.parse_args(rospy.myargv()[1:])
    rospy.init_node("drive_circle")
    try:
        good = CircleDriver(options).run()
    except (TimeoutError, RuntimeError, rospy.ROSException) as error:
        print("drive_circle: %s" % error, file=sys.stderr)
        return 1
    print("The circle is closed." if good else "The circle is NOT closed.")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
