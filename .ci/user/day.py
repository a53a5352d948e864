"""A designer's day at one size, scale, theme and language: takes a folder in, understands, compares, hands on, takes back."""

import argparse
import json
import os
import pathlib
import re
import shutil
import sys
import time

import desk
from desk import Desk, fresh

ROOT = pathlib.Path(__file__).resolve().parents[2]
# A text of the program: its name, in English, in German.
TEXT = re.compile(r'(?:const|fn) (\w+)(?:\([^)]*\))? = "((?:[^"\\]|\\.)*)" \| "((?:[^"\\]|\\.)*)";')


class Words:
    """What the window says, by the names that the program has for it: `commands.UNDO`."""

    def __init__(self, language):
        self.language = {"en": 0, "de": 1}[language]
        self.known = {}

    def __call__(self, name):
        file, text = name.split(".")
        if file not in self.known:
            source = (ROOT / "src/texts" / f"{file}.rs").read_text()
            self.known[file] = {found[0]: found[1:] for found in TEXT.findall(source)}
        return self.known[file][text][self.language]

    def pattern(self, name):
        """As a pattern of the whole name, anything for what is filled in."""
        return "^" + re.sub(r"\\\{\w+\\\}", ".+", re.escape(self(name)).replace(r"\ ", " ")) + "$"


class Day:
    def __init__(self, given, home):
        self.given = given
        self.width, self.height = (int(number) for number in given.size.split("x"))
        self.words = Words(given.language)
        os.environ["WINIT_X11_SCALE_FACTOR"] = given.scale
        os.environ["LANG"] = "de_DE.UTF-8" if given.language == "de" else "en_GB.UTF-8"
        self.desk = Desk(os.path.abspath(given.program), fresh(home))
        self.home = home
        self.taken = 0

    def start(self, *files):
        self.desk.start(*files)
        desk.run("xdotool", "windowmove", self.desk.window, "0", "0")
        desk.run("xdotool", "windowsize", "--sync", self.desk.window, str(self.width), str(self.height))
        desk.run("xdotool", "windowfocus", "--sync", self.desk.window)

    def picture(self, what):
        """Looks whether what can be used lies in the window, and takes a picture."""
        time.sleep(0.5)
        for node in self.desk.nodes():
            if node.role != "push button" or not node.rect or node.rect[2] <= 0 or not node.name:
                continue
            x, y, width, height = node.rect
            # Lists go on beyond what is in sight; nothing goes on to the right.
            if 0 <= y and y + height <= self.height and not (0 <= x and x + width <= self.width):
                raise AssertionError(f"{what}: {node.name!r} lies at {node.rect} of {self.given.size}")
        self.taken += 1
        if self.given.pictures:
            name = "-".join([self.given.size, self.given.theme, self.given.language, str(self.taken), what])
            self.desk.picture(os.path.join(self.given.pictures, f"{name}.png"))

    def command(self, text):
        """By the palette."""
        self.desk.key("ctrl+k")
        time.sleep(0.3)
        self.desk.type(text)
        time.sleep(0.3)
        self.desk.key("Return")
        time.sleep(0.4)

    def products(self):
        return [p["key"] for p in json.loads(self.desk.command("catalogue", "list", "--json").stdout) if not p["builtin"]]

    def take_in(self):
        folder = os.path.join(self.home, "incoming")
        shutil.copytree(os.path.join(self.given.data, "data/bsdf/tt_slats_b"), folder)
        os.chmod(folder, 0o755)
        self.start(folder)
        add = self.desk.need("|".join([self.words.pattern("import.ADD_ONE"), self.words.pattern("import.add_many")]), wait=20)
        self.desk.quiet()
        self.picture("take-in")
        self.desk.click(add)
        if self.desk.until(lambda: self.products(), 10) is None:
            raise AssertionError("nothing is in the catalogue")
        self.desk.quiet()

    def understand(self):
        self.picture("tiles")
        self.desk.key("ctrl+g")
        self.desk.quiet()
        time.sleep(1.5)
        self.picture("gallery")
        self.desk.key("ctrl+g")
        self.desk.key("0")
        for number in "15":
            self.desk.key(number)
            self.desk.quiet()
            self.picture({"1": "btdf", "5": "room"}[number])
        self.desk.key("0")

    def compare(self):
        for product in ["venetian blind 80/72, matt", "laser-cut panel"]:
            self.command(product)
            self.desk.quiet()
            self.command(self.words("commands.ADD_COMPARE"))
        self.command(self.words("commands.SHOW_COMPARE"))
        self.desk.quiet()
        self.picture("compare")
        self.command(self.words("commands.SHOW_COMPARE"))

    def hand_on(self):
        self.command(self.words("commands.EXPORT_LID").rstrip("…"))
        write = self.words.pattern("export.WRITE_TO")
        self.desk.need(write, "entry")
        self.desk.quiet()
        self.picture("hand-on")
        path = os.path.join(self.home, "window.ldt")
        self.desk.field(write, path, "entry")
        if self.desk.until(lambda: os.path.exists(path) and os.path.getsize(path) > 1000, 10) is None:
            raise AssertionError("no luminaire file")
        told = self.desk.command("info", path)
        if told.returncode:
            raise AssertionError(told.stderr)
        self.desk.key("Escape")

    def manners(self):
        self.command(self.words("commands.LARGER"))
        time.sleep(0.5)
        self.picture("larger")
        self.command(self.words("commands.NORMAL"))
        before = self.products()
        self.command(self.words("commands.DELETE_PRODUCT"))
        self.desk.key("ctrl+z")
        time.sleep(1)
        if self.products() != before:
            raise AssertionError(f"{before} before, {self.products()} after undo")

    def theme(self):
        """By the palette, in the language of the window; kept for the next start."""
        self.start()
        self.desk.quiet()
        said = self.words("commands.theme_is").replace("{choice}", self.words(f"commands.{self.given.theme.upper()}"))
        self.command(said)
        self.desk.stop()


def main():
    parser = argparse.ArgumentParser()
    for name in ["program", "size", "scale", "theme", "language"]:
        parser.add_argument(name)
    parser.add_argument("--data", default=os.environ.get("CFS_TEST_DATA"))
    parser.add_argument("--pictures")
    given = parser.parse_args()
    desk.switch_accessibility_on()
    day = Day(given, os.path.join(os.environ["CFS_USER_HOME"], "day"))
    at = f"{given.size} × {given.scale}, {given.theme}, {given.language}"
    started, step = time.time(), "start"
    try:
        for step in ["theme", "take_in", "understand", "compare", "hand_on", "manners"]:
            getattr(day, step)()
    except AssertionError as error:
        if given.pictures:
            day.desk.picture(os.path.join(given.pictures, f"{given.size}-{given.theme}-{given.language}-failed.png"))
        print(f"NOT SO {at}, {step}: {str(error)[:500]}")
        sys.exit(1)
    finally:
        day.desk.kill()
    print(f"holds  {at}: {time.time() - started:.0f} s")


main()
