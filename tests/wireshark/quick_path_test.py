#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The dissector's quick path, where nobody sees the tree, against its readers: same list, same fields, same filters.

usage: quick_path_test.py MXTP_LUA SOURCE_DIR [TEST…]
Exits 1 if anything differs, 77 where there is no tshark.
"""

import pathlib
import re
import shutil
import sys
import tempfile
import unittest

SCRIPT, SOURCE_DIR = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
sys.path[:0] = [str(SOURCE_DIR / "tests/support"), str(SOURCE_DIR / "tests/app/cli")]
import capture_writer  # noqa: E402
import dissected  # noqa: E402
from datagrams import as_tcp, as_udp, goldens, sound_and_broken  # noqa: E402

FIELDS = sorted(set(re.findall(r'"(mxtp\.[A-Za-z.]*[A-Za-z])"', SCRIPT.read_text("utf-8"))))
CONDITION, READERS = "not root.visible and dissect_quickly(tvb, root)", "local header, fault = read_header("
VISIBLE = ("-T", "fields", "-e", "frame.number")  # for this tshark makes a whole tree

# Asks for fields without making the tree visible, and prints what each frame has of them.
PRINT_FIELDS = """
local fields = {}
for name in ("NAMES"):gmatch("%S+") do fields[#fields + 1] = { name = name, values = Field.new(name) } end
local tap = Listener.new("frame")
function tap.packet(pinfo)
  for _, field in ipairs(fields) do
    for _, one in ipairs({ field.values() }) do
      local words = { pinfo.number, field.name, one.offset }
      if one.type ~= ftypes.NONE then -- those have a label and a length only where somebody sees the tree
        words[4], words[5] = one.len, tostring(one.value)
      end
      io.stdout:write(table.concat(words, " "), "\\n")
    end
  end
end
"""


class QuickPath(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        text = SCRIPT.read_text("utf-8")
        assert text.count(CONDITION) == 1 and text.count(READERS) == 1
        cls.readers, cls.quick_only = cls.folder / "readers.lua", cls.folder / "quick_only.lua"
        cls.readers.write_text(text.replace(CONDITION, "nil"), "utf-8")
        cls.quick_only.write_text(text.replace(READERS, 'error("no quick path")\n' + READERS), "utf-8")
        cls.udp, cls.tcp = cls.folder / "udp.pcap", cls.folder / "tcp.pcap"
        cls.udp.write_bytes(capture_writer.pcap(as_udp(sound_and_broken())))
        data = b"".join(goldens().values())
        cls.tcp.write_bytes(capture_writer.pcap(as_tcp([data[at:at + 700] for at in range(0, len(data), 700)])))

    def output(self, script: pathlib.Path, capture: pathlib.Path, *arguments: str) -> list:
        process = dissected.run_tshark(script, capture, self.folder, *arguments)
        output, _ = process.communicate(timeout=120)
        self.assertEqual(0, process.returncode)
        return output.decode("utf-8", "replace").splitlines()

    def compare(self, *arguments: str):
        for capture in (self.udp, self.tcp):
            wanted, got = (self.output(script, capture, *arguments) for script in (self.readers, SCRIPT))
            self.assertGreater(len(wanted), 5)
            for one, other in zip(wanted, got):
                self.assertEqual(one, other)
            self.assertEqual(len(wanted), len(got))

    def frames(self, script: pathlib.Path, wanted_filter: str, capture: pathlib.Path) -> list:
        return [int(line.split()[0]) for line in self.output(script, capture, "-Y", wanted_filter)]

    def test_shows_the_same_list(self):
        self.compare()

    def test_shows_the_same_columns(self):
        columns = ["%i", "%Cus:mxtp:0:R"] + [f"%Cus:{field}:0:R" for field in FIELDS]
        self.compare("-o", "gui.column.format:" + ",".join(f'"{i}","{column}"' for i, column in enumerate(columns)))

    def test_reports_the_same_oddities(self):
        self.compare("-q", "-z", "expert")

    def print_fields(self, capture: pathlib.Path, names: list, *arguments: str) -> list:
        printer = self.folder / "print_fields.lua"
        printer.write_text(PRINT_FIELDS.replace("NAMES", " ".join(names)), "utf-8")
        lines = self.output(SCRIPT, capture, "-X", f"lua_script:{printer}", *arguments)
        return [line for line in lines if re.match(r"\d+ mxtp", line)]

    def test_adds_the_same_fields(self):
        """A few at a time, since a datagram of texts goes to the readers if any of its fields is asked for."""
        for capture in (self.udp, self.tcp):
            wanted = self.print_fields(capture, FIELDS, *VISIBLE)
            if capture == self.udp:
                self.assertEqual(set(FIELDS), {line.split()[1] for line in wanted} | {"mxtp.skipped"})
            for names in [FIELDS[start::4] for start in range(4)]:
                lines = [line for line in wanted if line.split()[1] in names]
                for one, other in zip(lines, got := self.print_fields(capture, names)):
                    self.assertEqual(one, other)
                self.assertEqual(len(lines), len(got))

    def test_finds_the_same_datagrams_by_one_field(self):
        wanted = self.print_fields(self.tcp, FIELDS, *VISIBLE)
        for name in FIELDS[::6]:
            frames = sorted({int(line.split()[0]) for line in wanted if line.split()[1] == name})
            self.assertEqual(frames, self.frames(SCRIPT, name, self.tcp), name)

    def test_leaves_only_odd_datagrams_to_the_readers(self):
        self.assertEqual(self.frames(self.readers, "mxtp.error or mxtp.notice", self.udp),
                         self.frames(self.quick_only, "_ws.lua.error", self.udp))


if __name__ == "__main__":
    if shutil.which("tshark") is None:
        print("SKIPPED: there is no tshark; packaging/install-dependencies installs it")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
