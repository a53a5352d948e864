"""How much memory the window holds in an hour's work: every product of a large catalogue looked at, a ranking of all of
them, three years.

memory.py PROGRAM DATA; by `CFS_USER_CHECKS=memory.py .ci/user/run PROGRAM DATA`. DATA: folder of reference data, whose
BSDF files join the built-in products. Prints resident memory after each part, its peak, and what is left a minute later;
exit 1 if the peak is above 450 MB, or the rest above 350 MB.
"""

import os
import sys
import time

import desk
from pictures import Session

# Largest resident memory at any time, and a minute after the work. [MB]
PEAK, REST = 450, 350


def memory(session, entry):
    """An entry of the process's status. [MB]"""
    with open(f"/proc/{session.desk.app.pid}/status") as status:
        line = next(line for line in status if line.startswith(entry))
    return int(line.split()[1]) / 1024


def products(session):
    """every product looked at"""
    listed = session.desk.command("catalogue", "list").stdout.splitlines()
    session.choose("")
    for _ in listed:
        session.desk.key("Down")
        session.settle(4)
    print(f"{len(listed)} lines of the catalogue", flush=True)


def year(session):
    """a year"""
    session.command("Maximise Year")
    session.command("Compute a year")
    session.finished()
    session.desk.key("0")
    # The next year is of another product.
    session.choose("")
    session.desk.key(*["Down"] * 7)
    session.settle()


def rank(session):
    """a ranking of all products"""
    session.command("Maximise Ranking")
    session.desk.click(session.desk.need("^Rank ", wait=60))
    session.finished()
    session.desk.key("0")


def main():
    program, data = sys.argv[1:]
    os.environ["LANG"] = "en_GB.UTF-8"
    desk.switch_accessibility_on()
    session = Session(program, os.environ["CFS_USER_HOME"])
    imported = session.desk.command("catalogue", "import", os.path.join(data, "data", "bsdf"))
    print(imported.stdout[-200:], imported.stderr[-200:])
    try:
        session.start()
        files = memory(session, "RssFile")
        print(f"the window: {memory(session, 'VmRSS'):.0f} MB, of which {files:.0f} MB are program and libraries", flush=True)
        for part in (products, rank, year, year, year):
            part(session)
            print(f"{part.__doc__}: {memory(session, 'VmRSS'):.0f} MB, peak {memory(session, 'VmHWM'):.0f} MB", flush=True)
        time.sleep(60)
        rest, peak = memory(session, "VmRSS"), memory(session, "VmHWM")
        print(f"a minute later: {rest:.0f} MB (at most {REST}), peak {peak:.0f} MB (at most {PEAK})")
    finally:
        session.desk.kill()
    sys.exit(rest > REST or peak > PEAK)


main()
