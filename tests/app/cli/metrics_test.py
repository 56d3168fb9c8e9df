#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scrapes what `monitor --metrics` serves: by itself, against the report that monitor writes at the end, and by a real
Prometheus with the example alerts and each query of the example board. The same of the window, if it is built.

usage: metrics_test.py POSEWIRE_CLI EXAMPLES_FOLDER [POSEWIRE]
Exits 77 if there is no Prometheus, after the rest has passed.
"""
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.parse
import urllib.request

CHARACTERS = 2
TYPES = ("02", "12", "13")
CAUSES = {"this_computer": "thisComputer", "network": "network", "sender": "sender", "unknown": "unknown"}
PATIENCE = 40  # tries, a second apart
SERIES = re.compile(r'(\w+)(?:\{(.*)\})? (\S+)')
LABEL = re.compile(r'(\w+)="((?:[^"\\]|\\.)*)"')


def free_port(kind=socket.SOCK_DGRAM):
    with socket.socket(socket.AF_INET, kind) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def fetch(address):
    with urllib.request.urlopen(address, timeout=10) as answer:
        return answer.read().decode("utf-8")


def until(look, what):
    """The first result of look() that is true; a server that does not answer yet is looked at again."""
    for _ in range(PATIENCE):
        try:
            if result := look():
                return result
        except urllib.error.URLError:
            pass
        time.sleep(1)
    raise AssertionError("not after " + str(PATIENCE) + " s: " + what)


def series(text):
    """Values by name and labels."""
    found = {}
    for line in text.splitlines():
        if line.startswith("posewire_"):
            name, labels, value = SERIES.fullmatch(line).groups()
            key = name, frozenset(LABEL.findall(labels or ""))
            assert key not in found, line
            found[key] = float(value)
    return found


def value_of(scraped, name, **labels):
    wanted = frozenset(labels.items())
    values = [value for (one, its), value in scraped.items() if one == name and wanted <= its]
    assert values, (name, labels)
    return sum(values)


class Monitoring:
    """posewire-cli monitor --metrics, with performers that send to it and lose samples."""

    def __init__(self, cli):
        port = free_port()
        self.program = subprocess.Popen([cli, "monitor", "--udp", f"127.0.0.1:{port}", "--metrics", "127.0.0.1:0", "--json"],
                                        text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.address = re.search(r"metrics are at (\S+)", self.program.stderr.readline()).group(1)
        self.sender = subprocess.Popen([cli, "send", "--to", f"127.0.0.1:{port}", "--characters", str(CHARACTERS), "--rate", "60",
                                        "--types", ",".join(TYPES), "--drop", "0.05"], stdout=subprocess.DEVNULL)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for program in (self.sender, self.program):
            program.kill()
            program.communicate()

    def place(self):
        return urllib.parse.urlsplit(self.address).netloc

    def report(self):
        """What monitor writes at the end, and what was scraped last before."""
        self.sender.send_signal(signal.SIGINT)
        self.sender.wait(timeout=20)
        time.sleep(3)  # until nothing is pending, and the figures are those
        scraped = series(fetch(self.address))
        self.program.send_signal(signal.SIGINT)
        report = json.loads(self.program.communicate(timeout=20)[0])
        assert self.program.returncode == 0, self.program.returncode
        return report, scraped


def is_on_the_air(scraped):
    return {dict(labels).get("type") for name, labels in scraped if name == "posewire_stream_age_seconds"} == set(TYPES)


def check_report(report, scraped):
    """Every number is the one that the report has."""
    source, = report["sources"]
    assert value_of(scraped, "posewire_datagrams_total") == source["datagrams"]
    assert value_of(scraped, "posewire_bytes_total") == source["bytes"]
    assert value_of(scraped, "posewire_incidents") == len(report["incidents"])
    lost = dict.fromkeys(CAUSES, 0)
    for character in source["characters"]:
        who = {"id": str(character["id"]), "character": character["name"], "source": source["address"],
               "transport": source["transport"], "port": str(source["localPort"])}
        for stream in character["streams"]:
            which = {**who, "type": stream["type"]}
            assert value_of(scraped, "posewire_stream_datagrams_total", **which) == stream["datagrams"]
            if stream["type"] != "02":
                continue
            assert value_of(scraped, "posewire_stream_samples_total", **which) == stream["samples"]
            assert abs(value_of(scraped, "posewire_stream_jitter_seconds", **which) - stream["jitterMs"] / 1000) < 1e-6
            assert value_of(scraped, "posewire_stream_lost_samples", **which) == stream["lost"] + stream["incomplete"] > 0
            for label, key in CAUSES.items():
                assert value_of(scraped, "posewire_stream_lost_samples", cause=label, **which) == stream["causes"][key]
                lost[label] += stream["causes"][key]
    for label, samples in lost.items():
        assert value_of(scraped, "posewire_lost_samples", cause=label) >= samples


def check_refusals(cli, taken):
    for place in (taken, "studio:9464", "9464x", "127.0.0.1:70000"):
        refused = subprocess.run([cli, "monitor", "--udp", "127.0.0.1:0", "--metrics", place, "--duration", "1"],
                                 capture_output=True, text=True, timeout=20, check=False)
        complaint = refused.stderr.splitlines()[-1]
        assert refused.returncode == 2 and complaint.startswith("posewire-cli monitor: --metrics: "), refused
    assert subprocess.run([cli, "monitor", "/dev/null", "--metrics", "0"], capture_output=True, timeout=20,
                          check=False).returncode == 2


def promtool(*arguments, text=None):
    checked = subprocess.run(["promtool", *arguments], input=text, capture_output=True, text=True, timeout=60, check=False)
    assert checked.returncode == 0, checked
    return checked.stdout + checked.stderr


class Prometheus:
    def __init__(self, folder, examples, place):
        config = folder / "prometheus.yml"
        config.write_text(json.dumps({  # which is YAML
            "global": {"scrape_interval": "1s", "evaluation_interval": "1s"}, "rule_files": [str(examples / "alerts.yml")],
            "scrape_configs": [{"job_name": "posewire", "static_configs": [{"targets": [place]}]}]}), encoding="utf-8")
        own = f"127.0.0.1:{free_port(socket.SOCK_STREAM)}"
        self.api = f"http://{own}/api/v1/"
        self.program = subprocess.Popen(["prometheus", f"--config.file={config}", f"--storage.tsdb.path={folder / 'data'}",
                                         f"--web.listen-address={own}", "--log.level=error"], stdin=subprocess.DEVNULL,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.program.kill()
        self.program.wait()

    def ask(self, what, **query):
        return json.loads(fetch(self.api + what + "?" + urllib.parse.urlencode(query)))["data"]

    def query(self, expression):
        return self.ask("query", query=expression)["result"]

    def rules(self):
        return {rule["name"]: rule for group in self.ask("rules")["groups"] for rule in group["rules"]}


def queries_of(board):
    text = json.loads(board.read_text(encoding="utf-8"))
    for panel in text["panels"]:
        for target in panel["targets"]:
            expression = target["expr"].replace("$__rate_interval", "10s")
            yield panel["title"], re.sub(r"\$(instance|character)", ".*", expression)


def check_prometheus(monitoring, examples):
    with tempfile.TemporaryDirectory() as name, Prometheus(pathlib.Path(name), examples, monitoring.place()) as prometheus:
        rates = until(lambda: prometheus.query('posewire_stream_rate_hertz{type="02"} > 30'), "rates")
        assert len(rates) == CHARACTERS, rates
        until(lambda: prometheus.query("increase(posewire_stream_samples_total[10s]) > 60"), "samples")
        until(lambda: prometheus.rules()["PosewireLoss"]["state"] != "inactive", "an alert on 5 % loss")
        for title, expression in queries_of(examples / "grafana.json"):
            assert prometheus.query(expression), (title, expression)
        rules = prometheus.rules()
        assert {rule["health"] for rule in rules.values()} == {"ok"}, rules
        for quiet in ("PosewireDown", "PosewireStuck", "PosewireDroppedHere", "PosewireNoData"):
            assert rules[quiet]["state"] == "inactive", rules[quiet]


def check_window(window):
    """The demo's figures, and an end as that of others."""
    with tempfile.TemporaryDirectory() as folder:
        environment = dict(os.environ, QT_QPA_PLATFORM="offscreen", HOME=folder, XDG_CONFIG_HOME=folder, XDG_CACHE_HOME=folder)
        program = subprocess.Popen([window, "--demo", "1", "--udp", f"127.0.0.1:{free_port()}", "--no-tour", "--metrics", "127.0.0.1:0"], text=True,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=environment)
        try:
            address = next(found for line in program.stderr if (found := re.search(r"metrics are at (\S+)", line))).group(1)
            until(lambda: series(fetch(address)).get(("posewire_characters", frozenset())) == 1, "the character of the demo")
            refused = subprocess.run([window, "--metrics", urllib.parse.urlsplit(address).netloc], capture_output=True, text=True,
                                     timeout=60, env=environment, check=False)
            assert refused.returncode == 2 and "posewire: --metrics: " in refused.stderr, refused
            program.send_signal(signal.SIGINT)
            program.communicate(timeout=60)
            assert program.returncode == 0, program.returncode
        finally:
            program.kill()
            program.communicate()


def main(cli, examples, window=None):
    if window:
        check_window(window)
    has_prometheus = shutil.which("prometheus") and shutil.which("promtool")
    with Monitoring(cli) as monitoring:
        until(lambda: is_on_the_air(series(fetch(monitoring.address))), "streams of all types")
        check_refusals(cli, monitoring.place())
        if has_prometheus:
            assert "SUCCESS" in promtool("check", "rules", str(examples / "alerts.yml"))
            promtool("test", "rules", str(pathlib.Path(__file__).with_name("alerts_test.yml")))
            found = promtool("check", "metrics", text=fetch(monitoring.address))
            assert "posewire" not in found and "process" not in found, found
            check_prometheus(monitoring, examples)
        check_report(*monitoring.report())
    if not has_prometheus:
        print("there is no Prometheus: its part is left out")
        return 77
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), *sys.argv[3:]))
