# SPDX-License-Identifier: GPL-3.0-or-later
"""Installs Posewire under Wine, uses it as an operator would, and removes it again.

usage: check_installed.py SETUP.EXE POSEWIRE FOLDER   (POSEWIRE: this computer's own window; pictures and files come into FOLDER)

The environment has WINEPREFIX and POSEWIRE_WINE_DISPLAY, as packaging/check-windows sets them.
"""
import json
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import time

WINE = [str(pathlib.Path(__file__).parent.parent / "wine")]
PREFIX = pathlib.Path(os.environ["WINEPREFIX"])
DRIVE = PREFIX / "drive_c"
SIZE = "1280x800"


def wine(program, *arguments):
    """What the program writes. Into a file: Wine's own processes keep a pipe open that it was started with."""
    with tempfile.TemporaryFile() as output:
        command = WINE + [str(program), *map(str, arguments)]
        done = subprocess.run(command, stdout=output, stderr=subprocess.STDOUT, timeout=120)
        output.seek(0)
        written = output.read().decode()
    assert done.returncode == 0, f"{program} {arguments}: {done.returncode}\n{written}"
    return written


def windows_path(path):
    return "Z:" + str(pathlib.Path(path).resolve()).replace("/", "\\")


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        return taken.getsockname()[1]


def pixels(png):
    """Width, height, and the rows of the picture as a list of colours, three bytes each."""
    bitmap = subprocess.run(["pngtopnm", png], stdout=subprocess.PIPE, check=True).stdout
    kind, width, height = bitmap[:64].split(maxsplit=3)[:3]
    assert kind == b"P6", f"{png} is no picture with colours"
    width, height = int(width), int(height)
    colours = bitmap[-3 * width * height :]
    return width, height, [colours[i : i + 3] for i in range(0, len(colours), 3)]


def files():
    """All of the Windows but what Windows itself writes."""
    return {str(path.relative_to(DRIVE)) for path in DRIVE.rglob("*") if "Temp" not in path.parts}


def install(setup):
    wine(setup, "/S", "/CurrentUser")
    program = next(DRIVE.glob("users/*/AppData/Local/Programs/Posewire/posewire.exe"))
    assert list(DRIVE.glob("users/*/AppData/Roaming/Microsoft/Windows/Start Menu/Programs/Posewire/Posewire.lnk"))
    return program


def check_live(program, cli, folder):
    """The window shows what the command line sends on this computer."""
    port = free_port()
    picture = folder / "live.png"
    sender = subprocess.Popen(WINE + [str(cli), "send", "--to", f"127.0.0.1:{port}", "--characters", "2"])
    try:
        wine(program, "--udp", port, "--no-tour", "--size", SIZE, "--settings", windows_path(folder / "settings.json"),
             "--after", 6, "--screenshot", windows_path(picture), "--force")
    finally:
        sender.terminate()
        sender.wait()
    width, height, shown = pixels(picture)
    assert (width, height) == (1280, 800), (width, height)
    colours = len(set(shown))
    assert colours > 500, f"{picture}: {colours} colours, so no bodies"
    return colours


def check_recording(cli, folder):
    """Records to a name with letters that no code page has together; reports; exports. Nothing is blamed on this computer."""
    port = free_port()
    take = folder / "Aufnahme – José 動.pcapng"
    report = folder / "report.html"
    lines = (folder / "monitor.json").open("w+")
    receiver = subprocess.Popen(
        WINE + [str(cli), "monitor", "--udp", str(port), "--duration", "5", "--json", "--record", windows_path(take), "--force"],
        stdout=lines)
    time.sleep(1)
    wine(cli, "send", "--to", f"127.0.0.1:{port}", "--duration", 3, "--characters", 2, "--seed", 5)
    receiver.wait()
    lines.seek(0)
    summary = json.loads(lines.read().splitlines()[-1])
    assert summary["local"]["kernelDropped"] is None, summary["local"]
    assert sum(source["datagrams"] for source in summary["sources"]) > 1000
    assert take.stat().st_size > 1_000_000
    wine(cli, "report", windows_path(take), "-o", windows_path(report), "--force")
    assert "not known here" in report.read_text()
    wine(cli, "export", windows_path(take), "--to", windows_path(folder / "motion.glb"), "--force")
    assert (folder / "motion.glb").read_bytes()[:4] == b"glTF"
    return take


def bodies(picture):
    """The share of pixels with a colour, which the floor has none of. Fonts decide how large the viewport is."""
    width, height, colours = picture
    return sum(max(colour) - min(colour) > 60 for colour in colours) / (width * height)


def check_same_picture(program, own, take, folder):
    """A moment of the recording looks as in this computer's own window."""
    pictures = []
    arguments = ["--seek", "1", "--part", "viewport", "--no-tour", "--size", SIZE, "--theme", "dark", "--force"]
    for name in ("windows", "linux"):
        picture = folder / f"viewport-{name}.png"
        settings = folder / f"settings-{name}.json"
        if name == "windows":
            wine(program, windows_path(take), *arguments, "--settings", windows_path(settings), "--screenshot",
                 windows_path(picture))
        else:
            subprocess.run([own, take, *arguments, "--settings", settings, "--screenshot", picture], check=True, timeout=300,
                           env=os.environ | {"QT_QPA_PLATFORM": "offscreen"})
        pictures.append(pixels(picture))
    ours, theirs = (bodies(picture) for picture in pictures)
    assert 0.6 < ours / theirs < 1.6, f"bodies are {ours:.4f} of the viewport here, {theirs:.4f} on Linux"
    return ours, theirs


def main():
    setup, own, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    before = files()
    program = install(setup)
    cli = program.with_name("posewire-cli.exe")
    assert wine(cli, "--version").startswith("posewire-cli "), "no version"
    colours = check_live(program, cli, folder)
    take = check_recording(cli, folder)
    ours, theirs = check_same_picture(program, own, take, folder)
    wine(setup, "/S", "/CurrentUser")  # as an upgrade
    wine(program.with_name("uninstall.exe"), "/S", "/CurrentUser")
    for _ in range(100):
        left = {name for name in files() - before if "Posewire" in name and "posewire\\cache" not in name}
        left = {name for name in left if "AppData/Local/Posewire" not in name and "Documents" not in name}
        if not left:
            break
        time.sleep(0.1)
    assert not left, f"the uninstaller left {sorted(left)}"
    print(f"Installed, live ({colours} colours), recorded, exported, removed; bodies are {ours:.4f} of the viewport, {theirs:.4f} on Linux.")


if __name__ == "__main__":
    main()
