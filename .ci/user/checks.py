"""What a person finds true of the window: one function a sentence, each from a cold start with an empty home."""

import argparse
import json
import os
import re
import shutil
import sys
import time
import traceback

import desk
from desk import Desk, fresh

CHECKS = []


def check(sentence):
    def keep(function):
        CHECKS.append((function.__name__, sentence, function))
        return function

    return keep


class Given:
    """What a check works with: the program, an empty home, reference data, a place for pictures."""

    def __init__(self, program, data, pictures, name):
        self.home = fresh(f"{os.environ['CFS_USER_HOME']}/{name}")
        self.desk = Desk(program, self.home)
        self.data = data
        self.pictures = pictures
        self.name = name
        self.taken = 0

    def picture(self):
        if self.pictures:
            self.taken += 1
            self.desk.picture(f"{self.pictures}/{self.name}-{self.taken}.png")

    def copy(self, *parts, to=None):
        """A reference file under the home, by its own or another name."""
        source = os.path.join(self.data, *parts)
        target = os.path.join(self.home, to or parts[-1])
        os.makedirs(os.path.dirname(target), exist_ok=True)
        shutil.copy(source, target)
        return target


def expect(holds, said):
    if not holds:
        raise AssertionError(said)


def place_in(words, pattern):
    match = re.search(pattern, words)
    expect(match, f"no {pattern!r} in {words[:2000]!r}")
    return match


def open_files(given, *files):
    """Starts with files, as a file manager does."""
    given.desk.start(*files)
    given.desk.need("Catalogue")


def incidence(given):
    """What the tiles say of the light that they show."""
    return given.desk.need(r"θ \d+°, φ \d+° · τ").name


def select(given, words, name):
    """Searches a product and clicks it."""
    given.desk.key("ctrl+f")
    given.desk.key("ctrl+a")
    given.desk.type(words)
    given.desk.click(given.desk.need(name, "list item"))
    given.desk.key("Escape")
    given.desk.quiet()


# Three products of three kinds, by place in the reference data.
DIFFERENT = ["clear_and_venetian_w7/ven45.xml", "fabric_model_tt3/t3.xml", "honeycomb_panel/CS-TBK7-12.xml"]


# The first start.


@check("painted within a second, six true tiles within two, nothing untrue before")
def first_start(given):
    seen = given.desk.start()
    tiles = ["Tile BTDF", "Tile Transmittance", "Tile Sky", "Tile LID", "Tile Room", "Tile Control"]
    untrue = re.compile(r"does not move|has no sky yet|dataset: no warnings")
    full, last = None, None
    while time.time() - given.desk.started < 12 and last is None:
        names = given.desk.names()
        words = "\n".join(names)
        moment = time.time() - given.desk.started
        read = re.search(r"θ \d+°, φ \d+° · τ", words)
        expect(read or not untrue.search(words), f"at {moment:.1f} s, with nothing read yet: {untrue.search(words)}")
        # Of the LID's peak, which takes a table of all directions, the tile says that it is being computed.
        loaded = re.search(r"peak: computing|peak [\d.]+ k?cd", words) and re.search(r"mean [\d.]+ k?lx|± [\d.]+ k?lx", words)
        if loaded and all(tile in names for tile in tiles) and "updating" not in words:
            full = full or moment
            if not last and "computing…" not in words:
                last = moment
    given.picture()
    print(f"    window {seen:.2f} s, six tiles {full and round(full, 2)} s, last figure {last and round(last, 2)} s")
    expect(full is not None, "no figures in the tiles within 12 s")
    expect(seen <= 1.0 and full <= 2.0, f"window {seen:.2f} s, tiles {full:.2f} s")


@check("“prismatic” finds its products at once, and their data are there within two seconds")
def built_in(given):
    given.desk.start()
    given.desk.need("Search", "entry")
    given.desk.key("ctrl+f")
    given.desk.type("prismatic")
    took = given.desk.until(lambda: sum("rismatic" in n.name for n in given.desk.nodes() if n.role == "list item") >= 2, 3)
    given.picture()
    expect(took is not None, "no prismatic products in the list")
    first = [node for node in given.desk.nodes() if node.role == "list item"][0]
    given.desk.click(first)
    start = time.time()
    there = given.desk.until(lambda: re.search(r"τ 0\.\d", incidence(given)), 8)
    given.desk.quiet()
    print(f"    found after {took:.2f} s, data after {time.time() - start:.1f} s")
    given.picture()
    expect(there is not None and time.time() - start < 4, f"data after {time.time() - start:.1f} s")


# One truth in every place.


@check("a saved scene that follows the sun still follows it; at night the room is dark")
def night(given):
    path = f"{given.home}/night.toml"
    given.desk.start()
    given.desk.need("Time", "slider")
    given.desk.quiet()
    given.desk.key("ctrl+s")
    given.desk.field("Path", path, "entry")
    expect(given.desk.until(lambda: os.path.exists(path), 5), "the scene is not saved")
    given.desk.stop()
    given.desk.start(path)
    given.desk.need("Time", "slider")
    given.desk.quiet()
    given.desk.field("^Local time", "22:00", "entry")
    given.desk.quiet()
    given.picture()
    words = given.desk.all_text()
    expect("no light at the calculation points" in words, "nothing says that the room is dark at 22:00")
    expect(re.search(r"below the horizon", words), "nothing says that the sun is below the horizon")
    expect(not re.search(r"[-−]\d+(\.\d)?° altitude", words), "a height below nought")


@check("a click in BTDF: every place speaks of the same incidence")
def one_incidence(given):
    given.desk.start()
    given.desk.quiet()
    hemisphere = given.desk.need("Incident hemisphere", "image")
    x, y, width, height = hemisphere.rect
    given.desk.click(hemisphere, at=(x + width // 2, y + height // 4))
    given.desk.quiet()
    given.picture()
    words = given.desk.all_text()
    angles = re.findall(r"θ (\d+)°, φ (\d+)°", words)
    expect(len(angles) >= 2, f"only {angles} named")
    expect(len(set(angles)) == 1, f"two incidences: {sorted(set(angles))}")


@check("status line and room tile state one error")
def one_error(given):
    given.desk.start()
    given.desk.quiet()
    words = given.desk.all_text()
    x, y, width, height = given.desk.need("Floor plan of the room", "image").rect
    desk.run("xdotool", "mousemove", str(x + width // 3), str(y + height // 2))
    time.sleep(1)
    given.picture()
    words = given.desk.all_text()
    line = place_in(words, r"room: (.*)")[1]
    tile = place_in(words, r"([\d.]+) ± ([\d.]+) lx")
    print(f"    line {line!r}, tile {tile[0]!r}")
    told = float(place_in(line, r"≤ ?([\d.]+) % of each value")[1])
    expect(100 * float(tile[2]) / float(tile[1]) <= told, f"{tile[0]} is more than {told} %")


def hand_on_lid(given):
    """The sheet for handing on, with a luminaire file chosen."""
    given.desk.key("ctrl+k")
    time.sleep(0.6)
    given.desk.type("export lid")
    time.sleep(0.4)
    given.desk.key("Return")
    time.sleep(0.6)


@check("the LID tile's peak is that of the file it exports")
def peak(given):
    given.desk.start()
    given.desk.quiet()
    hand_on_lid(given)
    given.desk.field("^Write to$", f"{given.home}/lid.ldt", "entry")
    expect(given.desk.until(lambda: os.path.exists(f"{given.home}/lid.ldt"), 8), "no file")
    told = given.desk.command("info", f"{given.home}/lid.ldt").stdout
    given.picture()
    largest = float(place_in(told, r"Largest intensity\s+([\d.]+) cd")[1])
    words = given.desk.all_text()
    shown = re.search(r"direct sun(?:light)? ([\d.]+) (k|M)?cd", words) or place_in(words, r"peak ([\d.]+) (k|M)?cd")
    value = float(shown[1]) * {"k": 1e3, "M": 1e6, None: 1.0}[shown[2]]
    print(f"    shown {value:.4g} cd, in the file {largest:.4g} cd")
    expect(abs(value / largest - 1) < 0.05, f"{value:.4g} cd is shown, the file holds {largest:.4g} cd")


@check("keys have the names that stand on them")
def keys(given):
    given.desk.start()
    given.desk.quiet()
    given.desk.key("question")
    given.desk.need("^Keyboard shortcuts$")
    words = given.desk.all_text()
    given.picture()
    expect("Bracket" not in words, "a key called Bracket")


# Names and states.


@check("light-redirecting louvres come in a state that lets light in")
def louvres(given):
    given.desk.start()
    given.desk.need("Search", "entry")
    given.desk.key("ctrl+f")
    given.desk.type("louvre")
    time.sleep(1)
    rows = [node for node in given.desk.nodes() if node.role == "list item"]
    expect(rows, "no louvres found")
    given.desk.click(rows[0])
    given.desk.quiet()
    given.picture()
    tau = float(place_in(incidence(given), r"τ ([\d.]+)")[1])
    expect(tau > 0.0, f"τ {tau}")


@check("a product keeps its name whatever is searched")
def name_stays(given):
    given.desk.start()
    given.desk.quiet()
    title = next(n for n in given.desk.names() if "Stuttgart" in n)
    given.desk.key("ctrl+f")
    given.desk.type("opal")
    time.sleep(1)
    after = next(n for n in given.desk.names() if "Stuttgart" in n)
    expect(title == after, f"{title!r} became {after!r}")


@check("a fixed product: the control tile says what would move")
def fixed(given):
    given.desk.start()
    select(given, "clear glass double", "Clear glass, double")
    given.picture()
    words = given.desk.all_text()
    expect(re.search(r"one state|does not move|nothing.*moves", words), "the control tile says nothing")


# Taking in.


@check("a venetian, a fabric and a honeycomb are three products")
def three_products(given):
    open_files(given, *(given.copy("bsdf", *name.split("/")) for name in DIFFERENT))
    given.desk.need("Add .*to (the )?catalogue", wait=20)
    given.picture()
    expect("3 products" in given.desk.all_text(), "not said to be three products")
    given.desk.press("Add .*to (the )?catalogue")
    given.desk.quiet()
    listed = given.desk.command("catalogue", "list", "--json").stdout
    stored = sum(not product["builtin"] for product in json.loads(listed))
    expect(stored == 3, f"{stored} products stored")


@check("a family of files is one product whose states have their angles")
def family(given):
    names = [f"b{angle:02}.xml" for angle in (0, 10, 30, 45, 60)]
    open_files(given, *(given.copy("bsdf", "tt_slats_b", name) for name in names))
    given.desk.need("Add .*to (the )?catalogue", wait=20)
    given.picture()
    given.desk.press("Add .*to (the )?catalogue")
    given.desk.quiet()
    time.sleep(1)
    stored = [p for p in json.loads(given.desk.command("catalogue", "list", "--json").stdout) if not p["builtin"]]
    expect(len(stored) == 1, f"{len(stored)} products")
    told = json.loads(given.desk.command("catalogue", "show", stored[0]["key"], "--json").stdout)
    values = [state["value"] for state in told["states"]]
    expect(values == [0, 10, 30, 45, 60], f"values {values}")


@check("a typed path is opened by the keyboard alone")
def typed_path(given):
    path = given.copy("bsdf", "honeycomb_panel", "CS-TBK7-12.xml")
    given.desk.start()
    given.desk.quiet()
    given.desk.key("ctrl+o")
    given.desk.field("^Path$", path, "entry")
    given.desk.need("Add .*to (the )?catalogue", wait=20)
    given.picture()


@check("a folder is read")
def folder(given):
    for name in DIFFERENT:
        given.copy("bsdf", *name.split("/"), to=f"incoming/{name}")
    open_files(given, f"{given.home}/incoming")
    given.desk.need("Add .*to (the )?catalogue|left out|Skipped", wait=20)
    given.picture()
    expect("os error" not in given.desk.all_text(), "an error of the operating system")


@check("the same file again is told, not added in silence")
def twice(given):
    path = given.copy("bsdf", "honeycomb_panel", "CS-TBK7-12.xml")
    open_files(given, path)
    given.desk.press("Add .*to (the )?catalogue")
    given.desk.quiet()
    given.desk.stop()
    open_files(given, path)
    given.desk.need("already", wait=15)
    given.picture()


@check("products are renamed, deleted and restored")
def renamed(given):
    open_files(given, given.copy("bsdf", "honeycomb_panel", "CS-TBK7-12.xml"))
    given.desk.press("Add .*to (the )?catalogue")
    given.desk.quiet()
    row = given.desk.need("CS-TBK7-12", "list item")
    given.desk.click(row, button=3)
    given.desk.press("^Rename")
    given.desk.field("^Name$", "Honeycomb of ours", "entry")
    given.desk.press("^Save$")
    given.desk.click(given.desk.need("Honeycomb of ours", "list item"), button=3)
    given.picture()
    given.desk.press("^Delete$")
    time.sleep(0.5)
    expect(not given.desk.find("Honeycomb of ours", "list item", wait=1), "still in the list")
    given.desk.key("ctrl+z")
    expect(given.desk.find("Honeycomb of ours", "list item"), "undo does not bring it back")
    given.desk.key("ctrl+shift+z")
    time.sleep(0.5)
    given.desk.stop()
    given.desk.start()
    given.desk.need("Search", "entry")
    expect(not given.desk.find("Honeycomb of ours", "list item", wait=1), "back after a restart")
    key = json.loads(given.desk.command("catalogue", "restore", "--json").stdout or "[]")
    print(f"    deleted: {key}")


# Moments.


@check("date and time are typed; digits do not switch tiles")
def typed_moment(given):
    given.desk.start()
    given.desk.quiet()
    given.desk.field("^Date", "21 Jun", "entry")
    given.desk.field("^Local time", "14:30", "entry")
    given.desk.quiet()
    given.picture()
    words = given.desk.all_text()
    expect("21 Jun 14:30" in words, "the title does not say 21 Jun 14:30")
    expect(given.desk.find("Tile Sky", wait=1) and given.desk.find("Tile Room", wait=1), "a tile fills the bench")


@check("cities are found by their names")
def city(given):
    given.desk.start()
    given.desk.press("^Place", "toggle button")
    field = given.desk.need("(?i)city|place|search a place", "entry")
    given.desk.click(field)
    given.desk.key("ctrl+a")
    given.desk.type("kathm")
    time.sleep(0.6)
    given.picture()
    given.desk.key("Return")
    given.desk.quiet()
    expect("Kathmandu" in given.desk.all_text(), "not in Kathmandu")


@check("the sun that is dragged stays in its day")
def sun_stays_in_its_day(given):
    given.desk.start()
    given.desk.quiet()
    dome = given.desk.need("Sky dome", "image")
    x, y, width, height = dome.rect
    given.desk.picture(f"{given.home}/sky.png")
    # At noon in March the sun stands south, 41° high.
    for side in (0.62, 0.66, 0.70, 0.74, 0.78):
        given.desk.drag((x + width // 2 + 6, y + int(height * side)), (x + int(width * 0.75), y + int(height * 0.6)))
    given.desk.quiet()
    given.picture()
    words = next(n for n in given.desk.names() if "Stuttgart" in n)
    print(f"    {words}")
    expect("21 Mar" in words and "21 Mar 12:00" not in words, words)


@check("a window too high for its sill says so")
def sill(given):
    given.desk.start()
    given.desk.quiet()
    for section in ("Façade", "Date and time", "Sky"):
        given.desk.press(f"^{section}$", "toggle button")
    given.desk.press("^Apertures$", "toggle button")
    given.desk.field("^Sill", "1.2", "spin button")
    given.desk.field("^Height", "2.5", "spin button")
    given.desk.quiet()
    given.picture()
    words = given.desk.all_text()
    values = {node.name: node.value for node in given.desk.nodes() if node.role == "spin button"}
    print(f"    {values}")
    expect(re.search(r"Sill.* was set to 0\.50 m", words), "nothing is said of the sill")


@check("nothing moves when the sun leaves the façade")
def still(given):
    given.desk.start()
    given.desk.quiet()
    names = ["BTDF", "Transmittance", "Incident hemisphere", "Emergent hemisphere", "Sky dome", "LID polar diagram", "Sky model"]
    places = {name: given.desk.need(f"^{name}$").rect for name in names}
    for time_of_day in ("20:00", "5:00", "12:00"):
        given.desk.field("^Local time", time_of_day, "entry")
        given.desk.quiet()
        for name, rect in places.items():
            now = given.desk.need(f"^{name}$").rect
            expect(now == rect, f"{name} at {time_of_day}: {rect} became {now}")


@check("every state is there, named by its angle")
def states(given):
    given.desk.start()
    given.desk.quiet()
    named = [node for node in given.desk.nodes() if re.match(r"State [-−]?\d+°$", node.name)]
    given.picture()
    print(f"    {[node.name for node in named]}")
    expect(len(named) >= 12, f"{len(named)} states")


# Words that leave.


@check("exports offer product, state and moment, and ask before they replace")
def exports(given):
    given.desk.start()
    given.desk.quiet()
    hand_on_lid(given)
    offered = given.desk.need("^Write to$", "entry").text
    print(f"    {offered}")
    expect("venetian" in offered.lower() and "2026-03-21" in offered, f"offers {offered!r}")
    path = f"{given.home}/mine.ldt"
    with open(path, "w") as file:
        file.write("mine")
    given.desk.field("^Write to$", path, "entry")
    given.desk.need("already exists")
    given.picture()
    expect(open(path).read() == "mine", "replaced without asking")
    given.desk.press("^Replace$")
    expect(given.desk.until(lambda: os.path.getsize(path) > 1000, 8), "not written")


@check("messages leave by themselves, stay in a list, and never cover the status line")
def messages(given):
    given.desk.start()
    given.desk.quiet()
    given.desk.key("ctrl+o")
    given.desk.field("^Path$", f"{given.home}/nothing.toml", "entry")
    given.picture()
    message = given.desk.need("Dismiss: ")
    line = given.desk.need("^room: ")
    expect(message.rect[1] + message.rect[3] <= line.rect[1], f"{message.rect} covers {line.rect}")
    gone = given.desk.until(lambda: given.desk.find("Dismiss: ", wait=0) is None, 25)
    expect(gone, "still there after 25 s")
    expect(given.desk.find("^1 message$"), "nothing tells that there was a message")



@check("several files at once; an unknown word is an error that says so")
def arguments(given):
    told = given.desk.command("no-such-thing")
    expect(told.returncode == 2 and "no-such-thing" in told.stderr, f"{told.returncode} {told.stderr}")


@check("an edit outlives a kill a second later")
def survives(given):
    given.desk.start()
    given.desk.quiet()
    given.desk.key("Right")
    given.desk.key("Right")
    given.desk.key("Up")
    expect("22 Mar 14:00" in given.desk.all_text(), "keys do not move the moment")
    time.sleep(1.0)
    given.desk.kill()
    given.desk.start()
    given.desk.quiet()
    given.picture()
    expect("22 Mar 14:00" in given.desk.all_text(), "the edit is lost")


@check("typing errors and parts of words find products")
def forgiving(given):
    given.desk.start()
    given.desk.need("Search", "entry")
    for words, wanted in [("venezian", "enetian"), ("cut panel", "aser-cut"), ("rismat", "rismatic"), ("lasercut", "aser-cut")]:
        given.desk.key("ctrl+f")
        given.desk.key("ctrl+a")
        given.desk.type(words)
        time.sleep(0.8)
        rows = [node.name for node in given.desk.nodes() if node.role == "list item"]
        expect(any(wanted in row for row in rows), f"{words!r} finds {rows[:5]}")
    given.picture()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--data", default=os.environ.get("CFS_TEST_DATA"))
    parser.add_argument("--pictures")
    parser.add_argument("names", nargs="*")
    given = parser.parse_intermixed_args()
    if given.pictures:
        os.makedirs(given.pictures, exist_ok=True)
    data = given.data and os.path.join(given.data, "data")
    desk.switch_accessibility_on()
    failed, left_out = 0, 0
    for name, sentence, function in CHECKS:
        if given.names and name not in given.names:
            continue
        if "copy" in function.__code__.co_names and not data:
            left_out += 1
            print(f"LEFT OUT {name}: needs reference data")
            continue
        one = Given(os.path.abspath(given.program), data, given.pictures, name)
        try:
            function(one)
            print(f"holds  {name}: {sentence}")
        except AssertionError as error:
            failed += 1
            print(f"NOT SO {name}: {sentence}\n    {str(error)[:700]}")
        except Exception:
            failed += 1
            print(f"NOT SO {name}: {sentence}\n    {traceback.format_exc(limit=3)}")
        finally:
            one.desk.kill()
        sys.stdout.flush()
    print(f"{failed} not so, {left_out} left out")
    sys.exit(1 if failed else 0)


main()
