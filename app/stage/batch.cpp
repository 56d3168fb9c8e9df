// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/batch.h"

#include <algorithm>
#include <random>

namespace posewire::stage {
namespace {

class MemorySource final : public log::ByteSource {
public:
    explicit MemorySource(std::span<const std::byte> bytes) : m_left(bytes) {}
    tl::expected<std::size_t, log::FileError> read(std::span<std::byte> into) override {
        const std::size_t size = std::min(into.size(), m_left.size());
        std::ranges::copy(m_left.first(size), into.begin());
        m_left = m_left.subspan(size);
        return size;
    }
    [[nodiscard]] std::string name() const override { return "batch"; }

private:
    std::span<const std::byte> m_left;
};

} // namespace

std::string newRun() {
    std::random_device chance;
    std::string run;
    while (run.size() < 16) {
        run += "0123456789abcdef"[chance() % 16];
    }
    return run;
}

bool Batch::hasRoomFor(const log::Packet& packet) const {
    constexpr std::size_t kBeside = 1024; // its headers and comments
    return isEmpty() || m_bytes.size() + packet.bytes.size() + kBeside <= kMostBytes;
}

void Batch::clear() {
    m_bytes.clear();
    m_count = 0;
}

void Batch::add(const log::Packet& packet, const log::SenderInfo& sender) {
    if (isEmpty()) {
        m_first = packet.number;
        m_writer.emplace(m_sink);
        static_cast<void>(m_writer->begin({})); // memory takes everything
    }
    static_cast<void>(m_writer->add(packet, sender));
    ++m_count;
}

tl::expected<void, log::FileError> readBatch(std::span<const std::byte> bytes,
                                             const log::FileVisitor& visit) {
    MemorySource source(bytes);
    return log::readFile(source, visit);
}

} // namespace posewire::stage
