#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Installs into a folder of its own: nothing is forgotten, nothing else comes along, and what is there starts from there.

usage: install_test.py CMAKE BUILD_FOLDER
"""
import gzip
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

ICON_SIZES = (16, 22, 24, 32, 48, 64, 128, 256, 512)
PROGRAMS = ("posewire", "posewire-cli")
RESOURCES = pathlib.Path(__file__).resolve().parents[2] / "resources"
LIBRARIES = {"posewire": ["Qt", "Assimp", "QCustomPlot", "OpenGL"], "posewire-cli": ["Qt"]}
PACKAGES = PROGRAMS + ("wireshark-mxtp",)


def expected():
    files = {f"share/icons/hicolor/{size}x{size}/apps/posewire.png" for size in ICON_SIZES}
    files |= {"share/icons/hicolor/scalable/apps/posewire.svg", "share/applications/org.posewire.posewire.desktop",
              "share/metainfo/org.posewire.posewire.metainfo.xml", "share/mime/packages/posewire.xml",
              "share/licenses/posewire/MIT.txt", "share/licenses/posewire/GPL-3.0-or-later.txt",
              "share/doc/posewire-cli/formats.md", "share/doc/posewire-cli/metrics/alerts.yml", "share/doc/posewire-cli/metrics/grafana.json",
              "share/doc/posewire-cli/stage.md", "lib/systemd/system/posewire-probe.service",
              "share/doc-base/posewire", "libexec/posewire/posewire-import"}
    files |= {f"share/doc/posewire-cli/examples/{name}" for name in ("nats-server.conf", "nats-cluster.conf", "posewire-probe.default")}
    files |= {f"share/doc/posewire/html/{name}" for name in ("pages.js", "guide.js", "guide.css")}
    files |= {f"share/doc/posewire/html/{page.stem}.html" for page in (RESOURCES / "help").glob("*.md")}
    files |= {f"share/doc/posewire/html/pictures/{one.name}" for one in (RESOURCES / "pictures/help").glob("*.png")}
    for name in PROGRAMS:
        files |= {f"bin/{name}", f"share/man/man1/{name}.1.gz", f"share/bash-completion/completions/{name}"}
    for name in PACKAGES:
        files |= {f"share/doc/{name}/{file}" for file in ("copyright", "changelog.gz", "changelog.Debian.gz")}
        files.add(f"share/lintian/overrides/{name}")
    return files


def check_files(root):
    found = {path.relative_to(root).as_posix() for path in root.rglob("*") if path.is_file()}
    plugins = {path for path in found if re.fullmatch(r"lib.*/wireshark/plugins/mxtp\.lua", path)}
    assert len(plugins) == 1, plugins
    assert found - plugins == expected(), sorted((found - plugins) ^ expected())


def check_icons(root):
    for size in ICON_SIZES:
        head = (root / f"share/icons/hicolor/{size}x{size}/apps/posewire.png").read_bytes()[:24]
        assert head.startswith(b"\x89PNG") and struct.unpack(">II", head[16:]) == (size, size), size


def check_texts(root, version):
    for name in PROGRAMS:
        page = gzip.decompress((root / f"share/man/man1/{name}.1.gz").read_bytes()).decode()
        assert f'"Posewire {version}"' in page, page[:200]
    changes = gzip.decompress((root / "share/doc/posewire/changelog.Debian.gz").read_bytes()).decode()
    assert changes.startswith(f"posewire ({version}-"), changes
    assert f'<release version="{version}" date="' in (root / "share/metainfo/org.posewire.posewire.metainfo.xml").read_text()


def check_guide(root):
    pages = root / "share/doc/posewire/html"
    start = (pages / "index.html").read_text()
    assert "<h1" in start and 'href="causes.html"' in start, start[:400]
    assert (pages / "pages.js").read_text().startswith("const guide = [")


def check_programs(root, version):
    environment = dict(os.environ, QT_QPA_PLATFORM="none")
    for name in PROGRAMS:
        out = subprocess.run([root / "bin" / name, "--version"], env=environment, check=True, capture_output=True,
                             text=True).stdout
        assert out.splitlines()[0] == f"{name} {version}", out
        assert [line.split()[0] for line in out.splitlines()[1:]] == LIBRARIES[name], out


def main(cmake, build):
    version = (pathlib.Path(build) / "version/version.txt").read_text(encoding="utf-8").splitlines()[0]
    with tempfile.TemporaryDirectory() as name:
        subprocess.run([cmake, "--install", build, "--prefix", "/usr"], env=dict(os.environ, DESTDIR=name), check=True,
                       stdout=subprocess.DEVNULL)
        root = pathlib.Path(name) / "usr"
        check_files(root)
        check_icons(root)
        check_texts(root, version)
        check_guide(root)
        check_programs(root, version)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
