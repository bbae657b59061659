# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=60 label=hostless,smoke
"""The pages: every link leads somewhere, the first page is short, and what it says of the scenes is what they say themselves."""

import glob
import os
import re
import unittest

ROOT = os.environ.get("TALUS_SOURCE_DIR") or os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
PAGES = [os.path.join(ROOT, "README.md"), *sorted(glob.glob(os.path.join(ROOT, "doc", "*.md")))]
PROBLEMS = sorted(glob.glob(os.path.join(ROOT, "doc", "validation", "*.md")))
LONGEST = 1500      # words of a page
LONGER = {          # those in which things are looked up, or with many lines of scripts
    "fix_large_body.md": 1650, "from_lammps.md": 1700, "from_liggghts.md": 2250, "messages.md": 1900, "output.md": 1850}
FIRST = 900         # of README
ALL = 42000         # of all pages in doc
MOST = 40           # pages


def read(path):
    with open(path) as file:
        return file.read()


def anchors(text):
    """Names of the headings, as the usual viewers of Markdown make them."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    titles = re.findall(r"^#+ +(.*)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


class Pages(unittest.TestCase):

    def test_links(self):
        count = 0
        for page in PAGES + PROBLEMS:
            text = re.sub(r"^```.*?^```", "", read(page), flags=re.M | re.S)
            for link in re.findall(r"\]\(([^)\s]+)\)", text):
                if re.match(r"https?:", link):
                    continue
                count += 1
                path, _, anchor = link.partition("#")
                target = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
                where = f"{link} in {os.path.relpath(page, ROOT)}"
                self.assertTrue(os.path.exists(target), where)
                if anchor:
                    self.assertIn(anchor, anchors(read(target)), where)
        self.assertGreater(count, 100)

    def test_all_pages_are_listed(self):
        listed = re.findall(r"\]\((\w+\.md)", read(os.path.join(ROOT, "doc", "README.md")))
        self.assertEqual(sorted(set(listed) | {"README.md"}), [os.path.basename(page) for page in PAGES[1:]])

    def test_few_pages_and_none_is_long(self):
        self.assertLessEqual(len(PAGES[1:]), MOST, "merge what belongs together")
        total = 0
        for page in PAGES[1:]:
            words = len(read(page).split())
            self.assertLessEqual(words, LONGER.get(os.path.basename(page), LONGEST), f"shorten {os.path.relpath(page, ROOT)}")
            total += words
        self.assertLessEqual(total, ALL, "shorten the longest that say the least")

    def test_first_page(self):
        text = read(PAGES[0])
        self.assertLessEqual(len(text.split()), FIRST)
        scenes = re.findall(r"^\* `(\w+)`, ([\d ]+) (\w+): ", text, re.M)
        self.assertEqual(sorted(name for name, *_ in scenes), ["crushing", "dice", "drum", "gravel", "hopper", "lentils", "penetration", "settling", "wavetank"])
        for name, number, what in scenes:
            self.assertIn(f" {number} {what}\n", re.search("scripts/run.*\n", read(os.path.join(ROOT, "input", f"in.{name}")))[0])
        programs = re.findall(r"`(\w+)`", re.search(r"^Coupled programs: .*?\n\n", text, re.M | re.S)[0])
        self.assertGreater(len(programs), 4)
        for name in programs:
            self.assertTrue(glob.glob(os.path.join(ROOT, "examples", "*", f"{name}.py")), name)


if __name__ == "__main__":
    unittest.main()
