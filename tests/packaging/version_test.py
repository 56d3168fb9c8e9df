#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Names the version of small trees: a release, commits after it, changed files, clones without tags or history, archives.

usage: version_test.py CMAKE SOURCE_DIR   (skipped without git)
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(sys.argv[2])
ENVIRONMENT = dict(os.environ, GIT_CONFIG_GLOBAL=os.devnull, GIT_CONFIG_NOSYSTEM="1", GIT_AUTHOR_NAME="A", GIT_AUTHOR_EMAIL="a@b.invalid",
                   GIT_COMMITTER_NAME="A", GIT_COMMITTER_EMAIL="a@b.invalid", GIT_AUTHOR_DATE="1790000000 +0000",
                   GIT_COMMITTER_DATE="1790000000 +0000")


def git(tree, *arguments):
    return subprocess.run(["git", "-C", tree, *arguments], check=True, capture_output=True, env=ENVIRONMENT).stdout


def commit(tree, changes):
    """Commits CHANGELOG.md with these lines; returns the first 8 digits of the commit."""
    (tree / "CHANGELOG.md").write_text("# Changelog\n" + changes, encoding="utf-8")
    git(tree, "add", "--all")
    git(tree, "commit", "--quiet", "--message", "Change")
    return git(tree, "rev-parse", "--short=8", "HEAD").decode().strip()


def version(tree, following="0.2.0"):
    """What name_version.cmake writes: the name, and the time in seconds."""
    into = tree.parent / "named"
    script = SOURCE / "packaging/cmake/name_version.cmake"
    subprocess.run([sys.argv[1], f"-DSOURCE={tree}", f"-DNEXT={following}", f"-DINTO={into}", "-P", script], check=True)
    name, seconds = (into / "version.txt").read_text(encoding="utf-8").split()
    assert f'return "{name}";' in (into / "version.cpp").read_text(encoding="utf-8")
    return name, int(seconds)


def archive(tree, into):
    into.mkdir()
    subprocess.run(["tar", "--extract", "--directory", into], input=git(tree, "archive", "HEAD"), check=True)
    return into


def main():
    if not shutil.which("git"):
        print("git is not installed")
        return 77
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        tree = folder / "tree"
        git(folder, "init", "--quiet", tree)
        for file in (".git_archival.txt", ".gitattributes"):
            shutil.copy(SOURCE / file, tree)
        first = commit(tree, "## [0.1.0] - 2026-01-02\n")
        assert version(tree, "0.1.0")[0] == f"0.1.0+dev.0+g{first}"
        commit(tree, "## [Unreleased]\n## [0.1.0] - 2026-01-02\n")
        third = commit(tree, "## [Unreleased]\n- More\n## [0.1.0] - 2026-01-02\n")
        assert version(tree) == (f"0.2.0~dev.2+g{third}", 1790000000)
        git(tree, "tag", "v0.1.0", first)
        assert version(tree)[0] == f"0.2.0~dev.2+g{third}"

        (tree / "untracked").touch()
        assert version(tree)[0] == f"0.2.0~dev.2+g{third}"
        (tree / "untracked").unlink()
        (tree / "CHANGELOG.md").write_text("## [0.1.0] - 2026-01-02\n", encoding="utf-8")
        assert version(tree)[0] == f"0.2.0~dev.2+g{third}.dirty"
        git(tree, "checkout", "--quiet", ".")

        shallow = folder / "shallow"
        git(folder, "clone", "--quiet", "--depth", "1", "--no-tags", f"file://{tree}", shallow)
        assert version(shallow)[0] == f"0.2.0~dev+g{third}"
        assert version(archive(tree, folder / "between"))[0] == f"0.2.0~dev.2+g{third}"
        shutil.rmtree(shallow / ".git")
        assert version(shallow)[0] == "0.2.0~dev"

        last = commit(tree, "## [0.2.0] - 2026-02-03\n## [0.1.0] - 2026-01-02\n")
        assert version(tree)[0] == f"0.2.0+dev.3+g{last}", "no tag, no release"
        git(tree, "tag", "--annotate", "--message", "Release", "v0.2.0")
        assert version(tree) == ("0.2.0", 1790000000)
        assert version(archive(tree, folder / "release")) == ("0.2.0", 1790000000)
        (folder / "release/.git_archival.txt").write_bytes((SOURCE / ".git_archival.txt").read_bytes())
        assert version(folder / "release")[0] == "0.2.0", "CHANGELOG.md has it"
    return 0


if __name__ == "__main__":
    sys.exit(main())
