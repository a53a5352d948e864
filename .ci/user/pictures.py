"""Draws the pictures of the README: a designer's first session, with real key and pointer events.

pictures.py PROGRAM FOLDER; `.ci/screenshots` starts it on a display of its own.
"""

import os
import subprocess
import sys
import time

import desk
from desk import Desk, fresh

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SIZE = (1280, 720)
# Size of the tour's pictures. [px]
SMALL = "512x330"


class Session:
    def __init__(self, program, folder):
        self.desk = Desk(os.path.abspath(program), fresh(os.path.join(os.environ["CFS_USER_HOME"], "pictures")))
        self.folder = folder

    def start(self):
        self.desk.start()
        desk.run("xdotool", "windowmove", self.desk.window, "0", "0")
        desk.run("xdotool", "windowsize", "--sync", self.desk.window, *map(str, SIZE))
        desk.run("xdotool", "windowfocus", "--sync", self.desk.window)
        self.settle()

    def settle(self, wait=60.0):
        """Waits until nothing is being computed, and moves the pointer to where no tooltip opens."""
        self.desk.quiet(wait)
        desk.run("xdotool", "mousemove", "900", "16")
        time.sleep(1.0)

    def command(self, text):
        """Runs a command by the palette."""
        self.desk.key("ctrl+k")
        # Letters before the palette is open would be shortcuts.
        time.sleep(0.7)
        self.desk.type(text)
        self.desk.key("Return")

    def search(self, words, leave="Tab"):
        """Searches the catalogue; `leave`: key that leaves the field."""
        self.desk.key("ctrl+f", "ctrl+a", "BackSpace")
        self.desk.type(words)
        time.sleep(1.0)
        self.desk.key(leave)

    def choose(self, words):
        """Searches the catalogue and selects the first product found, from which arrow keys go on in the list."""
        self.search(words, "Return")
        self.settle()

    def picture(self, name, part=None):
        """Takes the window, or a part of it at the size of the tour's pictures: (x, y, width, height) [px]."""
        path = os.path.join(self.folder, name)
        self.desk.picture(path)
        x, y, width, height = part or (0, 0, *SIZE)
        crop = ["-crop", f"{width}x{height}+{x}+{y}", "+repage"] + (["-resize", f"{SMALL}!"] if part else [])
        subprocess.run(["convert", path, *crop, "-strip", path], check=True)

    def finished(self):
        """Waits until the year or the ranking is complete."""
        if self.desk.until(lambda: self.desk.find("^Stop$", wait=3) is None, 1200) is None:
            raise AssertionError("not complete within 20 minutes")
        self.dismiss()
        self.settle()

    def dismiss(self):
        """Closes messages."""
        while message := self.desk.find("^Dismiss: ", wait=0.5):
            self.desk.click(message)

    def callouts(self, name, marks):
        """Draws numbered circles: (x, y) [px] each."""
        path = os.path.join(self.folder, name)
        draw = []
        for number, (x, y) in enumerate(marks, 1):
            draw += ["-fill", "#e4572e", "-stroke", "white", "-strokewidth", "2", "-draw", f"circle {x},{y} {x + 17},{y}"]
            draw += ["-stroke", "none", "-fill", "white", "-pointsize", "22", "-annotate", f"+{x - 7}+{y + 8}", str(number)]
        font = os.path.join(ROOT, "assets/fonts/DejaVuSans.ttf")
        subprocess.run(["convert", path, "-font", font, *draw, "-strip", path], check=True)


# Tile area between catalogue and scene, and its upper part in the proportions of the tour's pictures.
TILES = (256, 36, 768, 495)


def first_window(session):
    """window.png, window-light.png: the first start; callouts on catalogue, tiles and scene"""
    session.start()
    session.desk.press("^Not now$")
    session.command("Theme: light")
    session.settle()
    session.picture("window-light.png")
    session.command("Theme: dark")
    session.settle()
    session.picture("window.png")
    session.callouts("window.png", [(130, 238), (511, 360), (1250, 60)])


def product_and_sun(session):
    """tour-1-product.png, tour-2-sun.png: a search, and the sun dragged to the afternoon"""
    session.search("redirecting")
    session.desk.click(session.desk.need("blind 80/72, mirror", "list item"))
    session.settle()
    session.picture("tour-1-product.png", (0, 30, 512, 330))
    x, y, width, height = session.desk.need("Sky dome", "image").rect
    session.desk.drag((x + width // 2 + 6, y + int(height * 0.70)), (x + int(width * 0.70), y + int(height * 0.66)))
    session.settle()
    session.picture("tour-2-sun.png", (768, 30, 512, 330))


def room(session):
    """room.png: the room in perspective"""
    session.command("Maximise Room")
    session.command("Room: perspective")
    session.desk.press("^log$")
    session.settle()
    session.picture("room.png")
    session.command("Room: plan")
    session.desk.key("0")
    session.settle()


def year(session):
    """year.png, tour-3-year.png: a year of weather, hour by hour"""
    session.command("Maximise Year")
    session.desk.press("^Compute a year$")
    session.finished()
    session.picture("year.png")
    session.picture("tour-3-year.png", TILES)


def rank(session):
    """rank.png, tour-4-rank.png: the products that the search finds, ranked"""
    session.search("screen")
    session.command("Maximise Ranking")
    session.desk.press("^only search results")
    session.desk.press("^Rank ")
    session.finished()
    session.picture("rank.png")
    session.picture("tour-4-rank.png", TILES)
    session.desk.key("0")


def export(session):
    """tour-5-export.png: a luminaire file before it is written"""
    session.command("Export LID")
    session.desk.click(session.desk.need("^Write to$", "entry"))
    session.desk.key("ctrl+a")
    session.desk.type("redirecting-blind.ldt")
    session.settle()
    session.picture("tour-5-export.png", (768, 30, 512, 330))
    session.desk.key("Escape")


def compare(session):
    """compare.png: two systems in the same room"""
    session.search("")
    session.command("Venetian blind 80/72, matt")
    session.settle()
    session.command("Add to comparison")
    session.command("redirecting blind 80/72")
    session.settle()
    session.command("Add to comparison")
    session.command("Show comparison")
    session.dismiss()
    session.settle()
    session.picture("compare.png")


def main():
    program, folder = sys.argv[1:]
    os.environ["WINIT_X11_SCALE_FACTOR"] = "1"
    os.environ["LANG"] = "en_GB.UTF-8"
    desk.switch_accessibility_on()
    session = Session(program, os.path.abspath(folder))
    try:
        for part in (first_window, product_and_sun, room, year, rank, export, compare):
            part(session)
            print(part.__doc__, flush=True)
    except AssertionError:
        session.picture("failed.png")
        raise
    finally:
        session.desk.kill()


if __name__ == "__main__":
    main()
