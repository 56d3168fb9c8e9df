// SPDX-License-Identifier: MIT
#include "core/filter/completion.h"
#include "core/filter/filter.h"
#include "core/filter/signal_tree.h"
#include "tests/support/golden.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

// Whatever the text: an error lies within it, what compiles can be asked of every kind of datagram and says
// the same each time, and completion replaces bytes of the text at every cursor.
namespace {

using namespace posewire;

void require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

struct Sample {
    explicit Sample(const std::vector<std::byte>& from) : bytes(from) {
        packet.bytes = bytes;
        auto decoded = wire::decode(bytes);
        isDecoded = decoded.has_value();
        datagram = isDecoded ? std::move(*decoded) : wire::Datagram();
        digest = model::PacketDigester().add(packet, isDecoded ? &datagram : nullptr);
    }

    std::vector<std::byte> bytes;
    log::Packet packet;
    wire::Datagram datagram;
    bool isDecoded = false;
    model::PacketDigest digest;
};

/// The goldens, each also cut off.
std::vector<std::unique_ptr<Sample>> makeSamples() {
    std::vector<std::unique_ptr<Sample>> all;
    for (const auto& golden : test::goldens()) {
        all.push_back(std::make_unique<Sample>(golden.bytes));
        const auto half = static_cast<std::ptrdiff_t>(golden.bytes.size() / 2);
        all.push_back(std::make_unique<Sample>(
            std::vector<std::byte>(golden.bytes.begin(), golden.bytes.begin() + half)));
    }
    return all;
}

void checkMatching(const filter::Filter& compiled) {
    static const auto samples = makeSamples();
    const log::SenderInfo sender{"192.168.1.20:4001", log::Transport::Udp, 9763};
    for (const auto& sample : samples) {
        const wire::Datagram* datagram = sample->isDecoded ? &sample->datagram : nullptr;
        const filter::Candidate candidate{sample->packet, sample->digest, datagram, &sender};
        require(compiled.matches(candidate) == compiled.matches(candidate));
    }
}

void checkCompletions(std::string_view text) {
    constexpr std::size_t kMostCursors = 200;
    for (std::size_t cursor = 0; cursor <= std::min(text.size(), kMostCursors); ++cursor) {
        for (const auto& complete : {&filter::completions, &filter::signalCompletions}) {
            for (const filter::Completion& one : complete(text, cursor)) {
                require(one.offset <= cursor && one.offset + one.length <= text.size() && !one.text.empty());
            }
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto compiled = filter::Filter::compile(text);
    if (compiled) {
        checkMatching(*compiled);
    } else {
        const filter::FilterError& error = compiled.error();
        require(error.offset <= size && error.length <= size - error.offset && !error.text.empty());
    }
    if (const auto signal = filter::parsedSignal(text); !signal) {
        const filter::FilterError& error = signal.error();
        require(error.offset <= size && error.length <= size - error.offset && !error.text.empty());
    }
    checkCompletions(text);
    return 0;
}
