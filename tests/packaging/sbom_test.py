#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a bill of materials of a program with all libraries that it links, and holds it to what SPDX 2.3 asks of each element.

usage: sbom_test.py SOURCE_DIR PROGRAM KIND   (skipped where no dpkg is)
"""
import hashlib
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ID = re.compile(r"SPDXRef-[A-Za-z0-9.-]+")
KINDS = {"DESCRIBES", "CONTAINS", "STATIC_LINK", "DEPENDS_ON"}


def linked(program):
    """Libraries that the program loads."""
    text = subprocess.run(["ldd", program], check=True, capture_output=True, text=True).stdout
    return re.findall(r"=> (/\S+)", text)


def check_licence(expression, document):
    words = set(re.findall(r"[\w.+-]+", expression)) - {"AND", "OR", "WITH"}
    own = {each["licenseId"] for each in document.get("hasExtractedLicensingInfos", [])}
    assert {word for word in words if word.startswith("LicenseRef-")} <= own, expression
    try:
        from license_expression import get_spdx_licensing  # pylint: disable=import-outside-toplevel
    except ImportError:
        return
    known = get_spdx_licensing().validate(re.sub(r"LicenseRef-[\w.-]+", "MIT", expression))
    assert not known.errors, known.errors


def check(document, artefact):
    assert document["spdxVersion"] == "SPDX-2.3" and document["dataLicense"] == "CC0-1.0" and document["SPDXID"] == "SPDXRef-DOCUMENT"
    assert document["name"] == artefact.name and re.fullmatch(r"urn:uuid:[0-9a-f-]{36}", document["documentNamespace"])
    assert document["creationInfo"]["created"] == "2026-09-21T14:13:20Z" and document["creationInfo"]["creators"]
    ids = [each["SPDXID"] for each in document["packages"]]
    assert len(ids) == len(set(ids)) and all(ID.fullmatch(each) for each in ids), ids
    for package in document["packages"]:
        for field in ("name", "versionInfo", "downloadLocation", "licenseConcluded", "licenseDeclared", "copyrightText"):
            assert package[field], (package, field)
        assert package["filesAnalyzed"] is False
        check_licence(package["licenseDeclared"], document)
    assert document["packages"][0]["checksums"] == [
        {"algorithm": "SHA256", "checksumValue": hashlib.sha256(artefact.read_bytes()).hexdigest()}]
    for relation in document["relationships"]:
        assert relation["relationshipType"] in KINDS, relation
        assert {relation["spdxElementId"], relation["relatedSpdxElement"]} <= set(ids) | {"SPDXRef-DOCUMENT"}, relation
    related = {relation["relatedSpdxElement"]: relation["relationshipType"] for relation in document["relationships"]}
    assert set(related) == set(ids), "each package is related"
    return related


def main(source, program, kind):
    if not shutil.which("dpkg-query"):
        print("no dpkg")
        return 77
    with tempfile.TemporaryDirectory() as name:
        artefact = pathlib.Path(name) / "artefact.tar"
        artefact.write_bytes(b"content")
        subprocess.run([source / "packaging/sbom", artefact, "posewire", "1.2.3~dev.4+gabc", "1790000000", kind,
                        "--bundled", *linked(program), "--needed", "libc6", "fonts-that-are-not-installed"], check=True)
        related = check(json.loads(pathlib.Path(f"{artefact}.spdx.json").read_text(encoding="utf-8")), artefact)
        assert related["SPDXRef-libeigen3-dev"] == "STATIC_LINK" and related["SPDXRef-libqt6core6"] == "CONTAINS", related

        unknown = subprocess.run([source / "packaging/sbom", artefact, "posewire", "1", "0", "--needed", "bash"], capture_output=True, text=True, check=False)
        assert unknown.returncode == 1 and "packaging/libraries lacks" in unknown.stderr, unknown
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), *sys.argv[2:]))
