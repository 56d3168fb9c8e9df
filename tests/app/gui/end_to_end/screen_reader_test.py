#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a screen reader finds in the window: over AT-SPI, under Xvfb, while two characters are received with faults.

Every dock of every layout is looked at, also those behind tabs: each table gives rows, cells and values, each control
has a name.

usage: screen_reader_test.py POSEWIRE POSEWIRE_CLI     (starts itself again under a D-Bus of its own)
"""
import os
import socket
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
NO_BUS = 75
DEPTH = 40
MOST = 20_000  # objects: what is asked for must stay bounded


def start_again():
    """In a session with an accessibility bus that nobody else uses."""
    system = "/usr/bin/python3"  # it has what the distribution packages
    interpreter = system if os.path.exists(system) else sys.executable
    for _ in range(4):  # the registry of accessible programs sometimes ends as it begins
        with tempfile.TemporaryDirectory(prefix="runtime_", ignore_cleanup_errors=True) as runtime:
            environment = dict(os.environ, POSEWIRE_AT_SPI="1", QT_LINUX_ACCESSIBILITY_ALWAYS_ON="1",
                               QT_QPA_PLATFORM="xcb", XDG_RUNTIME_DIR=runtime)
            code = subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1600x1000x24", "dbus-run-session", "--",
                                   interpreter, *sys.argv], env=environment, timeout=240).returncode
        if code != NO_BUS:
            break
    sys.exit(code)


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Window:
    def __init__(self, program, folder, port, layout):
        self.process = subprocess.Popen([program, "--settings", folder + "/settings.json", "--layout", layout,
                                         "--size", "1500x900", "--no-tour", "--udp", str(port)], env=dict(os.environ))
        self.root = None

    def find(self):
        desktop = Atspi.get_desktop(0)
        for i in range(desktop.get_child_count()):
            one = desktop.get_child_at_index(i)
            if one is not None and one.get_process_id() == self.process.pid:
                return one
        return None

    def wait(self):
        for _ in range(40):
            self.root = self.find()
            if self.root is not None and self.root.get_child_count() > 0:
                return
            time.sleep(0.2)
        print("the window is not on the accessibility bus")
        sys.exit(NO_BUS)


def objects(root):
    """All that is shown below, with the path of names to it."""
    left = [(root, "", 0)]
    count = 0
    while left:
        one, path, depth = left.pop()
        count += 1
        assert count < MOST, "too much to list: " + path
        states = one.get_state_set()
        if depth > 1 and not states.contains(Atspi.StateType.VISIBLE):
            continue
        yield one, path
        if depth < DEPTH and not states.contains(Atspi.StateType.MANAGES_DESCENDANTS):
            for i in range(one.get_child_count()):
                child = one.get_child_at_index(i)
                if child is not None:
                    left.append((child, path + "/" + (child.get_name() or child.get_role_name()), depth + 1))


def tables(root):
    return {one.get_name(): one for one, _ in objects(root)
            if one.get_role() in (Atspi.Role.TABLE, Atspi.Role.TREE, Atspi.Role.TREE_TABLE)}


def rows(table):
    """Texts of the cells, row by row."""
    grid = table.get_table_iface()
    cells = []
    for row in range(grid.get_n_rows()):
        line = [grid.get_accessible_at(row, column) for column in range(grid.get_n_columns())]
        cells.append([cell.get_name() if cell is not None else "" for cell in line])
    return cells


def check_controls(root):
    for one, path in objects(root):
        if one.get_role() in (Atspi.Role.PUSH_BUTTON, Atspi.Role.TOGGLE_BUTTON, Atspi.Role.CHECK_BOX,
                              Atspi.Role.RADIO_BUTTON, Atspi.Role.COMBO_BOX, Atspi.Role.ENTRY, Atspi.Role.TEXT,
                              Atspi.Role.SPIN_BUTTON) and one.get_state_set().contains(Atspi.StateType.SHOWING):
            assert len(one.get_name().strip()) > 1, f"a control has no name: {path} ({one.get_role_name()})"
            assert "&&" not in one.get_name() and "   " not in one.get_name(), f"a name to be looked at: {path}"


def control(root, name):
    """What is called so, and can be used."""
    found = [one for one, _ in objects(root)
             if one.get_name() == name and one.get_role() in (Atspi.Role.PUSH_BUTTON, Atspi.Role.TOGGLE_BUTTON,
                                                              Atspi.Role.CHECK_BOX)]
    assert found, f"no control is called {name}"
    return found[0]


def has(one, state):
    one.clear_cache()
    return one.get_state_set().contains(state)


def check_states(root):
    """What is on, what is off, and what cannot be used now; and that pressing changes it."""
    toggle = control(root, "Trouble first")
    assert has(toggle, Atspi.StateType.ENABLED) and not has(toggle, Atspi.StateType.CHECKED)
    for isOn in (True, False):
        toggle.get_action_iface().do_action(0)
        time.sleep(0.5)
        assert has(toggle, Atspi.StateType.CHECKED) == isOn, f"it was pressed, and is {'off' if isOn else 'on'}"
    assert has(control(root, "History"), Atspi.StateType.CHECKED)
    assert not has(control(root, "Current"), Atspi.StateType.CHECKED)
    assert not has(control(root, "Selection"), Atspi.StateType.ENABLED), "nothing is selected to zoom to"
    assert has(control(root, "Pause"), Atspi.StateType.ENABLED)
    shown = tables(root)["Characters"].get_table_iface().get_accessible_at(0, 0)
    assert has(shown, Atspi.StateType.CHECKED), "a character that is in the picture is not said to be"


def bring_to_front(root, dock):
    """A dock that is behind a tab, or closed."""
    found = [one for one, _ in objects(root) if one.get_role() == Atspi.Role.PAGE_TAB and one.get_name() == dock]
    assert found, f"no tab is called {dock}"
    found[0].get_action_iface().do_action(0)
    time.sleep(1)


def check_tables(root, wanted):
    found = tables(root)
    print("tables:", {name: len(rows(one)) for name, one in sorted(found.items())})
    for name in wanted:
        assert name in found, f"no table is called {name}: {sorted(found)}"
        grid, filled = found[name].get_table_iface(), rows(found[name])
        assert filled and all(any(line) for line in filled), f"{name} has rows without text: {filled}"
        assert len(filled[0]) > 1, f"{name} has {len(filled[0])} column"
        headers = [grid.get_column_description(column) for column in range(grid.get_n_columns())]
        assert not found[name].get_description(), f"{name} is filled and says: {found[name].get_description()}"
        for line in filled:
            assert not any(cell.startswith(("▲", "■", "●")) for cell in line), f"{name} speaks shapes: {line}"
        NAMED[name] = headers


NAMED = {}
DOCKS = {"Check": {"Incidents": ["Incidents"], "Faults": ["Faults"], None: ["Characters", "Clocks of the sender"]},
         "Debug": {"Packets": ["Packets"], "Incidents": ["Incidents"], "Faults": ["Faults"],
                   "Inspector": ["Fields of the packet"], "Null pose": ["Segments of the null pose"],
                   "Trackers": ["Trackers", "Selected tracker"],
                   None: ["Characters", "Metadata", "Statistics of streams", "This computer", "Clocks of the sender"]},
         "Inspect": {"Inspector": ["Fields of the packet"], "Null pose": ["Segments of the null pose"],
                     None: ["Characters", "Metadata", "Trackers"]}}


def check_layout(window, layout):
    root = window.root
    for dock, wanted in DOCKS[layout].items():
        if dock is not None:
            bring_to_front(root, dock)
        check_tables(root, wanted)
        check_controls(root)


def check_live(window):
    root = window.root
    bring_to_front(root, "Packets")
    found = tables(root)
    board = rows(found["Characters"])
    assert any("Mira Lindqvist" in cell for line in board for cell in line), board
    before = rows(found["Packets"])
    assert 1 < len(before) < 200, f"{len(before)} rows of packets: only those in sight are listed"
    time.sleep(1)
    assert rows(found["Packets"]) != before, "the packets stand still"
    bring_to_front(root, "Incidents")
    check_states(root)
    bring_to_front(root, "Inspector")
    bring_to_front(root, "Packets")
    names = [one.get_name() for one, _ in objects(root)]
    assert any(name.startswith(("Not good: ", "Not quite good: ")) for name in names), "the verdict has no name"
    assert "Hold this packet" in names and "Filter packets: Problems" in names
    times = [name for name in names if len(name) == 12 and name[2] == name[5] == ":"]
    assert times, "nothing says the time that is shown"


def main(folder):
    port = free_port()
    Atspi.init()
    Atspi.set_timeout(20000, 20000)  # ms: the first picture of a layout takes long on a busy machine
    Atspi.get_desktop(0).get_child_count()  # starts the registry
    time.sleep(1.5)
    sender = subprocess.Popen([sys.argv[2], "send", "--to", f"127.0.0.1:{port}", "--characters", "2", "--rate", "60",
                               "--drop", "0.02"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        for layout in DOCKS:
            window = Window(sys.argv[1], folder, port, layout)
            try:
                window.wait()
                time.sleep(4)
                check_layout(window, layout)
                if layout == "Debug":
                    check_live(window)
            finally:
                window.process.terminate()
                window.process.wait(20)
    finally:
        sender.terminate()


if "POSEWIRE_AT_SPI" not in os.environ:
    start_again()
try:
    import gi
    gi.require_version("Atspi", "2.0")
    from gi.repository import Atspi
except (ImportError, ValueError) as problem:
    print("skipped:", problem)
    sys.exit(SKIPPED)
with tempfile.TemporaryDirectory(prefix="screen_reader_") as own:
    main(own)
