#!/usr/bin/python3
"""Drives the demo's robot along a square by cmd_vel and shows what the drives are told and what they answer.

Ends with 0 when the robot's true pose, which only the simulator knows, is back within 5 cm of the start.
"""

import argparse
import math
import sys
import threading

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from nord_driver.msg import DriveStatus
from std_srvs.srv import SetBool

TOLERANCE = 0.05  # m


def heading_of(pose):
    q = pose.orientation
    return math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))


def wrapped(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


class Latest:
    """The newest message of a topic."""

    def __init__(self, topic, kind, part=lambda message: message):
        """Of each message only part(message) counts; None: none of it."""
        self._arrived = threading.Condition()
        self._message = None
        self._part = part
        rospy.Subscriber(topic, kind, self._take, queue_size=10)

    def _take(self, message):
        part = self._part(message)
        if part is None:
            return
        with self._arrived:
            self._message = part
            self._arrived.notify_all()

    def get(self):
        with self._arrived:
            return self._message

    def wait(self, what, limit, good=lambda message: True):
        with self._arrived:
            ready = self._arrived.wait_for(
                lambda: rospy.is_shutdown() or (self._message is not None and good(self._message)), limit)
            if not ready or rospy.is_shutdown():
                raise TimeoutError("%s: nothing after %.0f s" % (what, limit))
            return self._message


def base_of(diagnostics):
    return next((status for status in diagnostics.status if status.name == "nord_driver: base"), None)


class Table:
    """One line whenever a control or status word changes, and twice a second."""

    def __init__(self, left, right, odom, truth):
        self._left, self._right, self._odom, self._truth = left, right, odom, truth
        self._command = Twist()
        self._shown = None
        self._due = rospy.Time()
        self._start = rospy.Time.now()

    def head(self):
        print("STW, the control word:  047E idle (OFF1), 047F run.   SW1: setpoint, 4000 = 100 % = P105")
        print("ZSW, the status word:   0B31 ready to switch on, 0B37 operation enabled and at its setpoint; 0A.. while")
        print("                        the frequency ramps, 1... while the motor turns left (the right one is mirrored)")
        print("%7s | %13s | %-25s | %-25s | %-21s | %s" %
              ("", "cmd_vel", "left drive", "right drive", "odometry", "true pose"))
        print("%7s | %6s %6s | %4s %4s %4s %10s | %4s %4s %4s %10s | %6s %6s %7s | %6s %6s" %
              ("s", "m/s", "rad/s", "STW", "ZSW", "SW1", "Hz", "STW", "ZSW", "SW1", "Hz", "x", "y", "deg", "x", "y"))

    def say(self, text):
        print("-- " + text)
        sys.stdout.flush()

    def command(self, twist):
        self._command = twist

    def update(self):
        left, right, odom, truth = (source.get() for source in (self._left, self._right, self._odom, self._truth))
        if None in (left, right, odom, truth):
            return
        words = tuple((drive.control_word, drive.status_word) for drive in (left, right))
        now = rospy.Time.now()
        if words == self._shown and now < self._due:
            return
        self._shown, self._due = words, now + rospy.Duration(0.5)
        drives = " | ".join("%04X %04X %04X %7.2f Hz" % (
            drive.control_word, drive.status_word, drive.setpoints[0] & 0xFFFF, drive.frequency)
            for drive in (left, right))
        seen, true = odom.pose.pose, truth.pose.pose
        print("%7.2f | %6.2f %6.2f | %s | %6.3f %6.3f %7.1f | %6.3f %6.3f" % (
            (now - self._start).to_sec(), self._command.linear.x, self._command.angular.z, drives,
            seen.position.x, seen.position.y, math.degrees(heading_of(seen)), true.position.x, true.position.y))
        sys.stdout.flush()


class SquareDriver:
    def __init__(self, options):
        self._options = options
        self._left = Latest("/nord_driver/left/status", DriveStatus)
        self._right = Latest("/nord_driver/right/status", DriveStatus)
        self._odom = Latest("/odom", Odometry)
        self._truth = Latest("/nord_sim/truth/odom", Odometry)
        self._base = Latest("/diagnostics", DiagnosticArray, base_of)
        self._command = rospy.Publisher("/cmd_vel", Twist, queue_size=1)
        self._table = Table(self._left, self._right, self._odom, self._truth)

    def run(self):
        for side, drive in (("left", self._left), ("right", self._right)):
            drive.wait("the %s drive's status" % side, 30.0, lambda status: status.online)
        start = self._truth.wait("the simulator's truth", 10.0).pose.pose
        self._odom.wait("odometry", 10.0)
        self._table.head()
        self._table.say("both drives answer. The driver idles them with 047E (OFF1): disabled, and so at rest")
        self._watch(0.5)
        self._table.say("enable: 047F, the setpoint stays 0 until a velocity is commanded")
        self._enable(True)
        self._watch(0.5)
        for side in range(4):
            self._table.say("side %d: %.1f m forward" % (side + 1, self._options.side))
            self._forward(self._options.side)
            self._table.say("corner %d: 90 degrees to the left" % (side + 1))
            self._turn(math.pi / 2.0)
        self._table.say("disable: ramp to zero, 047E (OFF1) until the drives say \"ready to switch on\"")
        self._enable(False)
        self._watch(0.5)
        end = self._truth.get().pose.pose
        error = math.hypot(end.position.x - start.position.x, end.position.y - start.position.y)
        turned = math.degrees(wrapped(heading_of(end) - heading_of(start)))
        print("The true pose is %.1f cm and %.1f degrees from the start (%.0f cm allowed)." %
              (100.0 * error, turned, 100.0 * TOLERANCE))
        return error <= TOLERANCE

    def _enable(self, on):
        rospy.wait_for_service("/nord_driver/enable", 10.0)
        answer = rospy.ServiceProxy("/nord_driver/enable", SetBool)(on)
        # Refused for a moment after the drives have answered: the parameters that decide motion are being read.
        deadline = rospy.Time.now() + rospy.Duration(5.0)
        early = ("still being read", "is not known")
        while not answer.success and any(t in answer.message for t in early) and rospy.Time.now() < deadline:
            rospy.sleep(0.1)
            answer = rospy.ServiceProxy("/nord_driver/enable", SetBool)(on)
        self._table.say("~enable %s: %s" % (str(on).lower(), answer.message))
        if not answer.success:
            raise RuntimeError("~enable %s was refused: %s" % (str(on).lower(), answer.message))

    def _check_enabled(self):
        """Without it the square would be waited for in vain when the base has stopped by itself."""
        if all(drive.get().operation_enabled for drive in (self._left, self._right)):
            return
        base = self._base.wait("the base's diagnostics", 3.0, lambda status: status.level == DiagnosticStatus.ERROR)
        raise RuntimeError("%s. On a busy computer the simulator may have been too late: try again" % base.message)

    def _watch(self, duration):
        end = rospy.Time.now() + rospy.Duration(duration)
        while rospy.Time.now() < end and not rospy.is_shutdown():
            self._table.update()
            rospy.sleep(0.01)

    def _send(self, linear, angular):
        twist = Twist()
        twist.linear.x, twist.angular.z = linear, angular
        self._command.publish(twist)
        self._table.command(twist)
        self._table.update()

    def _approach(self, distance_left, command, top_speed, tolerance, creep):
        """Goes on until distance_left() is small, slowing down towards the end, then waits for standstill."""
        deadline = rospy.Time.now() + rospy.Duration(30.0)
        while abs(distance_left()) > tolerance:
            if rospy.is_shutdown() or rospy.Time.now() > deadline:
                raise TimeoutError("the robot does not get there: %.3f left" % distance_left())
            self._check_enabled()
            left = distance_left()
            command(math.copysign(max(creep, min(top_speed, 1.5 * abs(left))), left))
            rospy.sleep(0.02)
        while not self._standing():
            if rospy.is_shutdown() or rospy.Time.now() > deadline:
                raise TimeoutError("the robot does not come to rest")
            self._send(0.0, 0.0)
            rospy.sleep(0.02)

    def _standing(self):
        return all(abs(drive.get().frequency) < 0.05 for drive in (self._left, self._right))

    def _forward(self, distance):
        start = self._odom.get().pose.pose
        heading = heading_of(start)

        def left():
            now = self._odom.get().pose.pose.position
            return distance - ((now.x - start.position.x) * math.cos(heading) +
                               (now.y - start.position.y) * math.sin(heading))

        self._approach(left, lambda speed: self._send(speed, 0.0), self._options.speed, 0.003, 0.02)

    def _turn(self, angle):
        state = {"last": heading_of(self._odom.get().pose.pose), "turned": 0.0}

        def left():
            now = heading_of(self._odom.get().pose.pose)
            state["turned"] += wrapped(now - state["last"])
            state["last"] = now
            return angle - state["turned"]

        self._approach(left, lambda speed: self._send(0.0, speed), 1.2, 0.003, 0.05)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--side", type=float, default=1.0, help="length of a side in m")
    parser.add_argument("--speed", type=float, default=0.5, help="top speed in m/s")
    options = parser.parse_args(rospy.myargv()[1:])
    rospy.init_node("drive_square")
    try:
        good = SquareDriver(options).run()
    except (TimeoutError, RuntimeError, rospy.ROSException) as error:
        print("drive_square: %s" % error, file=sys.stderr)
        return 1
    print("The square is closed." if good else "The square is NOT closed.")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
