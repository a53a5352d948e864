"""A person at a desk: starts the program, reads what a screen reader reads, clicks, types, drags and takes pictures."""

import os
import re
import shutil
import signal
import subprocess
import time
import warnings

import gi

gi.require_version("Atspi", "2.0")
from gi.repository import Atspi, Gio, GLib  # noqa: E402

warnings.filterwarnings("ignore", category=DeprecationWarning)


def switch_accessibility_on():
    """Programs tell what they show only when somebody listens."""
    bus = Gio.bus_get_sync(Gio.BusType.SESSION)
    on = GLib.Variant("(ssv)", ("org.a11y.Status", "IsEnabled", GLib.Variant("b", True)))
    bus.call_sync(
        "org.a11y.Bus", "/org/a11y/bus", "org.freedesktop.DBus.Properties", "Set", on, None, Gio.DBusCallFlags.NONE, -1, None
    )
    Atspi.init()


class Node:
    """What is told of one part of the window: role, name, value, place on the screen."""

    def __init__(self, accessible, depth):
        self.accessible = accessible
        self.depth = depth
        self.role = accessible.get_role_name()
        self.name = accessible.get_name() or ""
        self.rect = None
        component = accessible.get_component_iface()
        if component:
            extents = component.get_extents(Atspi.CoordType.SCREEN)
            self.rect = (extents.x, extents.y, extents.width, extents.height)

    @property
    def centre(self):
        x, y, width, height = self.rect
        return x + width // 2, y + height // 2

    @property
    def text(self):
        """What a field holds."""
        try:
            iface = self.accessible.get_text_iface()
            return iface.get_text(0, iface.get_character_count()) if iface else ""
        except GLib.Error:
            return ""

    @property
    def checked(self):
        states = self.accessible.get_state_set()
        return any(states.contains(s) for s in (Atspi.StateType.CHECKED, Atspi.StateType.PRESSED, Atspi.StateType.SELECTED))

    @property
    def value(self):
        iface = self.accessible.get_value_iface()
        return iface.get_current_value() if iface else None

    def __repr__(self):
        return f"{self.role} {self.name!r} {self.rect}"


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, timeout=60)


class Desk:
    """A running program and its window."""

    def __init__(self, program, home, *arguments):
        self.program = program
        self.home = home
        self.arguments = arguments
        self.started = None
        self.app = None
        self.window = None

    def environment(self):
        return {
            **os.environ,
            "HOME": self.home,
            "XDG_DATA_HOME": f"{self.home}/data",
            "XDG_CONFIG_HOME": f"{self.home}/config",
            "XDG_CACHE_HOME": f"{self.home}/cache",
        }

    def start(self, *arguments):
        os.makedirs(self.home, exist_ok=True)
        self.started = time.time()
        log = open(f"{self.home}/log", "a")
        self.app = subprocess.Popen(
            [self.program, *(arguments or self.arguments)], stdout=log, stderr=log, env=self.environment(), cwd=self.home
        )
        self.window = None
        while self.window is None:
            if self.app.poll() is not None:
                raise AssertionError(f"the program ended with {self.app.returncode}: {open(log.name).read()[-300:]}")
            if time.time() - self.started > 30:
                raise AssertionError("no window within 30 s")
            found = run("xdotool", "search", "--onlyvisible", "--pid", str(self.app.pid)).stdout.split()
            if found:
                self.window = found[-1]
            time.sleep(0.02)
        run("xdotool", "windowfocus", "--sync", self.window)
        return time.time() - self.started

    def command(self, *arguments):
        """The same program without a window."""
        return subprocess.run([self.program, *arguments], capture_output=True, text=True, env=self.environment(), timeout=300)

    def stop(self):
        """Closes the window as its user does."""
        if self.app and self.app.poll() is None:
            self.key("ctrl+q")
            try:
                self.app.wait(10)
            except subprocess.TimeoutExpired:
                self.kill()
        self.app = None

    def kill(self):
        if self.app and self.app.poll() is None:
            self.app.send_signal(signal.SIGKILL)
            self.app.wait()
        self.app = None

    # What is there.

    def nodes(self):
        """All parts of the window, in reading order; gone ones are left out."""
        found = []

        def walk(accessible, depth):
            try:
                found.append(Node(accessible, depth))
                for index in range(accessible.get_child_count()):
                    child = accessible.get_child_at_index(index)
                    if child:
                        walk(child, depth + 1)
            except GLib.Error:
                pass

        desktop = Atspi.get_desktop(0)
        for index in range(desktop.get_child_count()):
            child = desktop.get_child_at_index(index)
            if child and child.get_process_id() == self.app.pid:
                walk(child, 0)
        return found

    def names(self):
        return [node.name for node in self.nodes() if node.name]

    def all_text(self):
        return "\n".join(self.names())

    def find(self, name, role=None, wait=6.0):
        """A part by its name, a pattern; the first one in reading order."""
        pattern = re.compile(name)
        end = time.time() + wait
        while True:
            for node in self.nodes():
                if pattern.search(node.name) and (role is None or node.role == role) and node.rect and node.rect[2] > 0:
                    return node
            if time.time() > end:
                return None
            time.sleep(0.1)

    def need(self, name, role=None, wait=6.0):
        node = self.find(name, role, wait)
        if node is None:
            raise AssertionError(f"nothing named {name!r}{' as ' + role if role else ''}")
        return node

    def until(self, holds, wait=10.0):
        """Waits until something holds; seconds that it took, or None."""
        start = time.time()
        while time.time() - start < wait:
            if holds():
                return time.time() - start
            time.sleep(0.1)
        return None

    def quiet(self, wait=20.0):
        """Waits until nothing in sight is being computed."""
        words = re.compile(r"updating|computing|coarse|preliminary|Opening the|Reading the|Computing the|Computing…|being read|not computed")

        def settled():
            names = self.names()
            return len(names) > 20 and not any(words.search(name) and "built-in" not in name for name in names)

        self.until(settled, wait)
        time.sleep(0.3)

    # What a hand does.

    def key(self, *keys):
        run("xdotool", "key", "--delay", "40", *keys)
        time.sleep(0.3)

    def type(self, text):
        run("xdotool", "type", "--delay", "25", text)
        time.sleep(0.4)

    def click(self, node, button=1, times=1, at=None):
        x, y = at or node.centre
        run("xdotool", "mousemove", str(x), str(y))
        time.sleep(0.15)
        run("xdotool", "click", "--repeat", str(times), "--delay", "80", str(button))
        time.sleep(0.4)

    def press(self, name, role=None):
        self.click(self.need(name, role))

    def drag(self, start, end, modifier=None):
        if modifier:
            run("xdotool", "keydown", modifier)
        run("xdotool", "mousemove", str(start[0]), str(start[1]))
        time.sleep(0.2)
        run("xdotool", "mousedown", "1")
        steps = 8
        for step in range(1, steps + 1):
            x = start[0] + (end[0] - start[0]) * step // steps
            y = start[1] + (end[1] - start[1]) * step // steps
            run("xdotool", "mousemove", str(x), str(y))
            time.sleep(0.05)
        run("xdotool", "mouseup", "1")
        if modifier:
            run("xdotool", "keyup", modifier)
        time.sleep(0.5)

    def field(self, name, text, role=None):
        """Clicks a field, replaces what it holds, and confirms."""
        self.click(self.need(name, role))
        self.key("ctrl+a")
        self.type(text)
        self.key("Return")

    def picture(self, path):
        run("import", "-window", "root", path)


def fresh(home):
    shutil.rmtree(home, ignore_errors=True)
    os.makedirs(home)
    return home
