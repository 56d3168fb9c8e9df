#!/usr/bin/env perl
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints bundles of Open Sound Control that come to a port of this computer: each a line of JSON with its size, time tag and
# messages. Debian's libprotocol-osc-perl reads them, which shares nothing with the library that Posewire writes with.
# usage: osc_reader.pl    (prints the port first; ends with standard output)
use strict;
use warnings;
use IO::Socket::INET;
use JSON::PP;
use Protocol::OSC;

my $socket = IO::Socket::INET->new(LocalAddr => "127.0.0.1", Proto => "udp") or die "no socket: $@";
$| = 1;
print $socket->sockport, "\n";
my $reader = Protocol::OSC->new;
while (defined $socket->recv(my $bytes, 65536)) {
    my ($time, @messages) = @{ $reader->parse($bytes) };
    print encode_json({ bytes => length $bytes, time => $time, messages => [map { [@$_] } @messages] }), "\n";
}
