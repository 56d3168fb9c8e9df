#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Two network namespaces joined by a veth pair that loses, doubles and reorders: what `posewire-cli monitor` counts
must agree with what the kernel counted on the way. And interfaces that come, go and change while it listens to a group.

    network_namespaces_test.py PATH/TO/posewire-cli [SEED…]

Skips (status 77) where the kernel or the user's rights forbid namespaces or impairments. Where there is no netem, a rate
limit with a short queue loses datagrams instead, and nothing is doubled or reordered."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
SENDER, RECEIVER = "10.77.0.1", "10.77.0.2"
PORT = 9763
SECONDS = 4


def skip(why):
    print(f"SKIPPED: {why}")
    sys.exit(SKIPPED)


def run(*command):
    return subprocess.run(command, capture_output=True, text=True)


def inside(name):
    """What goes before a command that is to run in a namespace. `ip netns exec` would mount a sysfs as well, which is
    refused where the root folder is no mount, as after chroot."""
    return ["nsenter", f"--net=/run/netns/{name}"]


class Namespaces:
    """Two namespaces of this process's own; they end with it."""

    def __init__(self):
        self.names = [f"posewire-{os.getpid()}-{side}" for side in ("sender", "receiver")]

    def __enter__(self):
        for name in self.names:
            if run("ip", "netns", "add", name).returncode != 0 or run(*inside(name), "true").returncode != 0:
                self.__exit__()
                skip("network namespaces are forbidden here")
        link = run("ip", "link", "add", "sender", "netns", self.names[0], "type", "veth", "peer", "name", "receiver",
                   "netns", self.names[1])
        if link.returncode != 0:
            self.__exit__()
            skip("there are no veth pairs here: " + link.stderr.strip())
        for name, device, address in zip(self.names, ("sender", "receiver"), (SENDER, RECEIVER)):
            run(*inside(name), "sh", "-c", "echo 1 > /proc/sys/net/ipv6/conf/all/disable_ipv6")
            self.run(name, "ip", "address", "add", address + "/24", "dev", device)
            self.run(name, "ip", "link", "set", device, "up")
        # Neighbours are known beforehand: nothing but the datagrams goes through the queue that counts.
        link = json.loads(self.run(self.names[1], "ip", "-j", "link", "show", "dev", "receiver"))
        self.run(self.names[0], "ip", "neighbour", "add", RECEIVER, "lladdr", link[0]["address"], "dev", "sender")
        return self

    def __exit__(self, *_):
        for name in self.names:
            run("ip", "netns", "delete", name)

    def run(self, name, *command):
        result = run(*inside(name), *command)
        if result.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: {result.stderr.strip()}")
        return result.stdout

    def start(self, name, *command):
        return subprocess.Popen([*inside(name), *command], stdout=subprocess.PIPE, text=True)

    def udp6_received(self, name):
        """Datagrams that programs have read from sockets of IPv6."""
        text = self.run(name, "cat", "/proc/net/snmp6")
        return int(re.search(r"^Udp6InDatagrams\s+(\d+)", text, re.M)[1])

    def udp(self, name, field):
        lines = [line.split() for line in self.run(name, "cat", "/proc/net/snmp").splitlines() if line.startswith("Udp:")]
        return int(dict(zip(*lines))[field])

    def queue(self):
        """Datagrams that left the sender's queue (doubles included), and those it dropped."""
        text = self.run(self.names[0], "tc", "-s", "qdisc", "show", "dev", "sender")
        match = re.search(r"Sent \d+ bytes (\d+) pkts? \(dropped (\d+)", text.replace("packets", "pkt"))
        return int(match[1]), int(match[2])


def impair(spaces, seed):
    """Sets what the path does from now on, and what to send over it. A rate limit loses in a pattern that may look like
    a stream sent at a fraction of its rate; with one stream, evenly spaced, it does not."""
    netem = ["tc", "qdisc", "add", "dev", "sender", "root", "netem", "delay", "2ms", "1ms", "loss", f"{2 + seed % 5}%",
             "duplicate", "2%", "reorder", "3%", "50%"]
    if run(*inside(spaces.names[0]), *netem).returncode == 0:
        return "loses, doubles and reorders", ["--characters", "2", "--types", "02,21"]
    limit = ["tc", "qdisc", "add", "dev", "sender", "root", "tbf", "rate", f"{1400 + 25 * (seed % 5)}kbit", "burst", "4k",
             "limit", "8k"]
    if run(*inside(spaces.names[0]), *limit).returncode == 0:
        return ("loses (a rate limit: this kernel has no netem, so nothing is doubled or reordered)",
                ["--characters", "1", "--types", "02"])
    return skip("this kernel has neither netem nor tbf")


GROUP = "239.77.0.1"


def joined(spaces, device):
    """Whether the receiver's namespace has the group joined on an interface, as the kernel says."""
    return GROUP in spaces.run(spaces.names[1], "ip", "maddress", "show", "dev", device)


def wait_for(condition, what):
    for _ in range(100):
        if condition():
            return
        time.sleep(0.1)
    raise RuntimeError("in vain: " + what)


def send_to_group(spaces, cli, device, seconds=1):
    sender = spaces.names[0]
    spaces.run(sender, "ip", "route", "replace", GROUP + "/32", "dev", device)
    return spaces.run(sender, cli, "send", "--to", f"{GROUP}:{PORT}", "--characters", "1", "--types", "02", "--rate",
                      "100", "--duration", str(seconds))


def check_groups(cli):
    """A group is joined where interfaces appear later, come up or change address, and left where they go."""
    with Namespaces() as spaces:
        sender, receiver = spaces.names
        spaces.run(receiver, "ip", "link", "set", "receiver", "down")
        monitor = subprocess.Popen([*inside(receiver), cli, "monitor", "--udp", str(PORT), "--multicast", GROUP, "--json",
                                    "--duration", "60"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        wait_for(lambda: f":{PORT:04X} " in spaces.run(receiver, "cat", "/proc/net/udp"), "the monitor listens")
        spaces.run(receiver, "ip", "link", "set", "receiver", "up")
        wait_for(lambda: joined(spaces, "receiver"), "an interface that came up is joined")
        send_to_group(spaces, cli, "sender")
        spaces.run(sender, "ip", "link", "add", "late-out", "type", "veth", "peer", "name", "late", "netns", receiver)
        for name, device, address in ((sender, "late-out", "10.78.0.1"), (receiver, "late", "10.78.0.2")):
            spaces.run(name, "ip", "address", "add", address + "/24", "dev", device)
            spaces.run(name, "ip", "link", "set", device, "up")
        wait_for(lambda: joined(spaces, "late"), "an interface that appeared is joined")
        send_to_group(spaces, cli, "late-out")
        spaces.run(receiver, "ip", "address", "delete", "10.78.0.2/24", "dev", "late")
        wait_for(lambda: not joined(spaces, "late"), "an interface without an address is left")
        spaces.run(receiver, "ip", "address", "add", "10.78.0.9/24", "dev", "late")
        wait_for(lambda: joined(spaces, "late"), "an interface with another address is joined")
        send_to_group(spaces, cli, "late-out")
        for number in range(30):  # more interfaces than a socket may have memberships at once
            spaces.run(receiver, "ip", "link", "add", f"short{number}", "type", "veth", "peer", "name", f"end{number}")
            spaces.run(receiver, "ip", "address", "add", f"10.79.{number}.1/24", "dev", f"short{number}")
            spaces.run(receiver, "ip", "link", "set", f"short{number}", "up")
            wait_for(lambda: joined(spaces, f"short{number}"), f"interface {number} of many is joined")
            spaces.run(receiver, "ip", "link", "delete", f"short{number}")
        monitor.terminate()
        report = json.loads(monitor.communicate(timeout=30)[0])
        counted = [(source["address"], source["datagrams"]) for source in report["sources"]]
        print(f"a group, by interfaces that came up, appeared and changed address: {counted}")
        return len(counted) == 3 and all(datagrams >= 90 for _, datagrams in counted)


def check_address(cli):
    """The monitor reports when the address that it listens on disappears and when it returns."""
    with Namespaces() as spaces, tempfile.NamedTemporaryFile("w+", encoding="utf-8") as errors:
        sender, receiver = spaces.names
        monitor = subprocess.Popen([*inside(receiver), cli, "monitor", "--udp", f"{RECEIVER}:{PORT}", "--json", "--duration",
                                    "60"], stdout=subprocess.PIPE, stderr=errors, text=True)

        def said():
            errors.seek(0)
            return errors.read()

        wait_for(lambda: f":{PORT:04X} " in spaces.run(receiver, "cat", "/proc/net/udp"), "the monitor listens")
        spaces.run(receiver, "ip", "address", "delete", RECEIVER + "/24", "dev", "receiver")
        wait_for(lambda: f"has the address {RECEIVER} any more" in said(), "the address is reported as gone")
        spaces.run(receiver, "ip", "address", "add", RECEIVER + "/24", "dev", "receiver")
        wait_for(lambda: f"{RECEIVER}:{PORT}: all is well now" in said(), "the address is reported as back")
        spaces.run(sender, cli, "send", "--to", f"{RECEIVER}:{PORT}", "--duration", "0.5")
        monitor.terminate()
        out, _ = monitor.communicate(timeout=30)
        print(f"an address that went and came back: {said()}")
        return len(json.loads(out)["sources"]) == 1


def link_local(spaces, name, device):
    wait_for(lambda: "fe80" in spaces.run(name, "ip", "-6", "-br", "address", "show", "dev", device, "-tentative"),
             "a link-local address")
    return re.search(r"fe80[^/]*", spaces.run(name, "ip", "-6", "-br", "address", "show", "dev", device))[0]


def check_zones(cli):
    """A group that names an interface is joined there alone, when it comes; a sender that is named with one is heard
    there alone."""
    with Namespaces() as spaces:
        sender, receiver = spaces.names
        for name in spaces.names:
            spaces.run(name, "sh", "-c", "for file in /proc/sys/net/ipv6/conf/*/disable_ipv6; do echo 0 > $file; done")
        group = [cli, "monitor", "--udp", str(PORT), "--multicast", "ff02::77%late", "--json", "--duration", "60"]
        monitor = subprocess.Popen([*inside(receiver), *group], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        wait_for(lambda: f":{PORT:04X} " in spaces.run(receiver, "cat", "/proc/net/udp6"), "the monitor listens")
        spaces.run(sender, "ip", "link", "add", "late-out", "type", "veth", "peer", "name", "late", "netns", receiver)
        for name, device in ((sender, "late-out"), (receiver, "late")):
            spaces.run(name, "ip", "link", "set", device, "up")
        wait_for(lambda: "ff02::77" in spaces.run(receiver, "ip", "maddress", "show", "dev", "late"), "the group is joined")
        elsewhere = "ff02::77" in spaces.run(receiver, "ip", "maddress", "show", "dev", "receiver")
        address = link_local(spaces, sender, "late-out")
        send = [cli, "send", "--characters", "1", "--types", "02", "--rate", "50", "--duration", "1", "--to"]
        before = spaces.udp6_received(receiver)
        spaces.run(sender, *send, f"[ff02::77%late-out]:{PORT}")
        wait_for(lambda: spaces.udp6_received(receiver) >= before + 50, "the group's datagrams are read")
        monitor.terminate()
        out, told = monitor.communicate(timeout=30)
        heard = [source["datagrams"] for source in json.loads(out)["sources"]]
        missing, well = told.find("there is no interface late here"), told.find("all is well now")
        good = heard == [50] and not elsewhere and 0 <= missing < well
        counts = []
        for zone in ("late", "receiver"):
            alone = [cli, "monitor", "--udp", str(PORT), "--sender", f"{address}%{zone}", "--json", "--duration", "60"]
            monitor = subprocess.Popen([*inside(receiver), *alone], stdout=subprocess.PIPE, text=True)
            wait_for(lambda: f":{PORT:04X} " in spaces.run(receiver, "cat", "/proc/net/udp6"), "the monitor listens")
            before = spaces.udp6_received(receiver)
            spaces.run(sender, *send, f"[{link_local(spaces, receiver, 'late')}%late-out]:{PORT}")
            wait_for(lambda: spaces.udp6_received(receiver) >= before + 50, "the sender's datagrams are read")
            monitor.terminate()
            report = json.loads(monitor.communicate(timeout=30)[0])
            counts.append((sum(source["datagrams"] for source in report["sources"]), report["local"]["refusedDatagrams"]))
        print(f"interfaces by name: a group {heard}, told {told!r}, a sender {counts}")
        return good and counts == [(50, 0), (0, 50)]


def streams_of(report):
    return [stream for source in report["sources"] for character in source["characters"] for stream in character["streams"]]


def total(streams, field):
    return sum(stream[field] for stream in streams)


def check(seed, cli):
    with Namespaces() as spaces, tempfile.TemporaryDirectory() as folder:
        effect, streams = impair(spaces, seed)
        sender, receiver = spaces.names
        monitor = spaces.start(receiver, cli, "monitor", "--udp", str(PORT), "--duration", str(SECONDS + 3), "--json")
        while spaces.run(receiver, "cat", "/proc/net/udp", "/proc/net/udp6").count(f":{PORT:04X} ") == 0:
            if monitor.poll() is not None:
                raise RuntimeError("posewire-cli monitor ended at once")
        arrived = spaces.udp(receiver, "InDatagrams")
        before = spaces.queue()
        truth_file = os.path.join(folder, "truth.json")
        spaces.run(sender, cli, "send", "--to", f"{RECEIVER}:{PORT}", *streams, "--rate", "240", "--duration",
                   str(SECONDS), "--seed", str(seed), "--truth", truth_file)
        report = json.loads(monitor.communicate(timeout=60)[0])
        left, dropped = (now - then for now, then in zip(spaces.queue(), before))
        arrived = spaces.udp(receiver, "InDatagrams") + spaces.udp(receiver, "InErrors") - arrived
        with open(truth_file, encoding="utf-8") as file:
            sent = total(streams_of(json.load(file)), "datagrams")
        return compare(seed, effect, report, {"sent": sent, "arrived": arrived, "dropped": dropped, "left": left})


def compare(seed, effect, report, kernel):
    streams = streams_of(report)
    counted = {field: total(streams, field) for field in ("datagrams", "samples", "lost", "duplicates", "reordered")}
    print(f"seed {seed}: the path {effect}; the kernel: {kernel}; the monitor: {counted}")
    faults = []
    here = report["local"]["kernelDropped"]
    if counted["datagrams"] + here != kernel["arrived"]:
        faults.append(f"{kernel['arrived']} datagrams arrived, {counted['datagrams']} counted, {here} dropped here")
    if counted["datagrams"] - counted["duplicates"] != counted["samples"]:
        faults.append("a sample of one datagram is neither counted once nor a duplicate")
    # What is lost before the first and after the last datagram that came, a receiver cannot know.
    unknown = kernel["sent"] - counted["samples"] - counted["lost"]
    if not 0 <= unknown <= 4 * 20:
        faults.append(f"of {kernel['sent']} samples {counted['samples']} came and {counted['lost']} are lost")
    if kernel["sent"] - counted["samples"] - here != kernel["dropped"]:
        faults.append(f"{kernel['dropped']} dropped on the way, {kernel['sent'] - counted['samples']} missing")
    if kernel["dropped"] == 0:
        faults.append("nothing was lost on the way: this proves nothing")
    for fault in faults:
        print(f"  FAULT: {fault}")
    return not faults


def main():
    cli = os.path.abspath(sys.argv[1])
    seeds = [int(text) for text in sys.argv[2:]] or [1]
    if os.geteuid() != 0:
        skip("this takes the rights of an administrator")
    if shutil.which("ip") is None or shutil.which("tc") is None:
        skip("there is no ip or no tc command (package iproute2)")
    sys.exit(0 if all([check_groups(cli), check_address(cli), check_zones(cli)] + [check(seed, cli) for seed in seeds]) else 1)


if __name__ == "__main__":
    main()
