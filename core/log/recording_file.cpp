// SPDX-License-Identifier: MIT
#include "core/log/recording_file.h"

#include "core/log/reassembly.h"
#include "core/log/shared_packet.h"
#include "core/log/tcp_framer.h"
#include "core/wire/byte_order.h"
#include "core/wire/header.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace posewire::log {
namespace {

using Bytes = std::span<const std::byte>;

/// No packet and no block of a sound file is longer.
constexpr std::uint32_t kLongestBlock = 16U << 20;

/// What pcap files begin with: in microseconds, then in nanoseconds, each in either byte order.
constexpr std::array<std::uint32_t, 4> kPcapMagics{0xa1b2c3d4, 0xd4c3b2a1, 0xa1b23c4d, 0x4d3cb2a1};
/// What pcapng files begin with; reads the same in both byte orders.
constexpr auto kSectionHeader = static_cast<std::uint32_t>(PcapngBlockType::SectionHeader);

/// Fills `into`, unless the source ends before.
tl::expected<std::size_t, FileError> readFully(ByteSource& source, std::span<std::byte> into) {
    std::size_t filled = 0;
    while (filled < into.size()) {
        const auto count = source.read(into.subspan(filled));
        if (!count) {
            return count;
        }
        if (*count == 0) {
            break;
        }
        filled += *count;
    }
    return filled;
}

/// Takes a capture apart into pieces of known size, after its first four bytes.
class PieceReader {
public:
    explicit PieceReader(ByteSource& source) : m_source(source) {}

    bool bigEndian = false;

    /// `size` bytes, valid until the next call; empty if the file ends before or cannot be read.
    std::optional<Bytes> take(std::size_t size) {
        m_offset += m_bytes.size();
        m_bytes.resize(size);
        const auto filled = readFully(m_source, m_bytes);
        if (!filled) {
            m_result = tl::unexpected(filled.error());
        } else if (*filled != size) {
            reportCut(m_offset + *filled);
        }
        return filled == size ? std::optional<Bytes>(m_bytes) : std::nullopt;
    }
    /// The same for what a packet or a block begins with: the file may end before it.
    std::optional<Bytes> takeNext(std::size_t size) {
        const std::uint64_t begin = m_offset + m_bytes.size();
        auto taken = take(size);
        if (!taken && m_end == begin) {
            m_result = {};
        }
        return taken;
    }
    /// In the file, of the first byte of the piece taken last.
    [[nodiscard]] std::uint64_t offset() const { return m_offset; }

    [[nodiscard]] std::uint16_t read16(const std::byte* from) const {
        const std::uint16_t value = wire::load16(from);
        return bigEndian ? value : __builtin_bswap16(value);
    }
    [[nodiscard]] std::uint32_t read32(const std::byte* from) const {
        const std::uint32_t value = wire::load32(from);
        return bigEndian ? value : __builtin_bswap32(value);
    }
    /// Nothing more can be read.
    void reportDamage(const char* what) {
        m_result =
            tl::unexpected(FileError{m_source.name() + ": is damaged at byte " + std::to_string(m_offset) +
                                         " (" + what + "); what comes before it was read",
                                     FileError::Kind::Damaged});
    }
    /// Why reading ended, unless at the end of the file.
    [[nodiscard]] const tl::expected<void, FileError>& result() const { return m_result; }

private:
    void reportCut(std::uint64_t end) {
        m_end = end;
        m_result = tl::unexpected(FileError{m_source.name() + ": is cut off: it ends at byte " +
                                                std::to_string(end) +
                                                ", amidst a packet; what comes before that packet was read",
                                            FileError::Kind::Cut});
    }

    ByteSource& m_source;
    std::vector<std::byte> m_bytes;
    std::uint64_t m_offset = 4;
    std::optional<std::uint64_t> m_end; ///< of the file, where it came too early
    tl::expected<void, FileError> m_result;
};

void readPcap(PieceReader& reader, std::uint32_t magic, Reassembly& reassembly) {
    const auto header = reader.take(20); // after the magic number
    if (!header) {
        return;
    }
    reader.bigEndian = magic == 0xa1b2c3d4U || magic == 0xa1b23c4dU;
    const bool hasNanoseconds = magic == 0xa1b23c4dU || magic == 0x4d3cb2a1U;
    const std::uint32_t linkType =
        reader.read32(header->data() + 16) & 0x0fffffffU; // the top bits are about checksums
    while (const auto record = reader.takeNext(16)) {
        const std::int64_t seconds = reader.read32(record->data());
        const std::int64_t fraction = reader.read32(record->data() + 4);
        const std::uint32_t size = reader.read32(record->data() + 8);
        if (size > kLongestBlock) {
            reader.reportDamage("a packet of impossible length");
            return;
        }
        const WallTime time(std::chrono::seconds(seconds) + Duration(fraction * (hasNanoseconds ? 1 : 1000)));
        const auto bytes = reader.take(size);
        if (!bytes) {
            return;
        }
        reassembly.add({linkType, *bytes, reader.offset(), time});
    }
}

/// What a capture says about a frame besides its bytes, on the way to the records that come of it.
class FrameNotes {
public:
    void addDrops(std::uint64_t drops) { m_drops += drops; }
    /// The first comment is ours where we have written the file.
    void setComments(std::vector<std::string> comments) {
        m_comments = std::move(comments);
        m_origin = m_comments.empty() ? std::nullopt : parseOrigin(m_comments.front());
        if (m_origin) {
            m_comments.erase(m_comments.begin());
        }
    }
    [[nodiscard]] bool isOfRecording() const { return m_origin.has_value(); }

    /// Drops go to the first record after them, also if their own frame was none of ours.
    void apply(FileRecord& record) {
        constexpr std::uint64_t most = UINT32_MAX;
        record.kernelDropsBefore = static_cast<std::uint32_t>(std::min(std::exchange(m_drops, 0), most));
        record.comments = m_comments;
        record.flags.stampedByKernel = record.time.has_value();
        if (m_origin) {
            record.flags = m_origin->flags;
            record.setBy = m_origin->setBy;
            record.sender->transport = m_origin->transport;
            record.sender->probe = m_origin->probe;
            record.sender->address = m_origin->address.value_or(record.sender->address);
        }
    }

private:
    std::uint64_t m_drops = 0;
    std::vector<std::string> m_comments;
    std::optional<RecordedOrigin> m_origin;
};

std::string_view textOf(Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Interface {
    std::uint32_t linkType = 0;
    std::uint32_t snapLength = 0; ///< the most bytes captured of a packet; 0 for all
    std::uint8_t resolution = 6;  ///< if_tsresol: 10^-n seconds, or 2^-n with the top bit
    std::int64_t offsetSeconds = 0;
};

/// Within these all may be subtracted from each other, and from now.
constexpr std::int64_t kFirstSecond = -7'258'118'400; ///< 1740-01-01
constexpr std::int64_t kLastSecond = 9'151'488'000;   ///< 2260-01-01

/// Whole nanoseconds, by long division; nothing for what no stamp should hold.
std::optional<WallTime> timeOf(std::uint64_t stamp, const Interface& interface) {
    const bool isBinary = (interface.resolution & 0x80U) != 0;
    const std::uint64_t base = isBinary ? 2 : 10;
    const unsigned finest = isBinary ? 60 : 18; // a digit more and ten seconds of it overflow
    unsigned exponent = interface.resolution & 0x7fU;
    for (; exponent > finest; --exponent) {
        stamp /= base;
    }
    std::uint64_t perSecond = 1;
    for (; exponent > 0; --exponent) {
        perSecond *= base;
    }
    // No sum: of numbers of 64 bits it may not fit.
    const std::uint64_t whole = stamp / perSecond;
    const auto seconds =
        static_cast<std::int64_t>(whole + static_cast<std::uint64_t>(interface.offsetSeconds));
    const bool isInside = seconds >= kFirstSecond && seconds <= kLastSecond;
    const bool hasWrapped = interface.offsetSeconds >= 0 ? whole > static_cast<std::uint64_t>(kLastSecond)
                                                         : whole > std::uint64_t{1} << 63U;
    if (!isInside || hasWrapped) {
        return std::nullopt;
    }
    auto nanoseconds = static_cast<std::uint64_t>(seconds);
    std::uint64_t rest = stamp % perSecond;
    for (int digit = 0; digit < 9; ++digit) {
        nanoseconds = nanoseconds * 10 + rest * 10 / perSecond;
        rest = rest * 10 % perSecond;
    }
    return WallTime(Duration(static_cast<std::int64_t>(nanoseconds)));
}

class PcapngReader {
public:
    PcapngReader(PieceReader& reader, Reassembly& reassembly, FrameNotes& notes,
                 const NotesVisitor& visitNotes)
        : m_reader(reader), m_reassembly(reassembly), m_notes(notes), m_visitNotes(visitNotes) {}

    /// The first four bytes, a section header's type, have been taken.
    void read() {
        bool hasMore = readSectionHeader();
        while (hasMore) {
            hasMore = readBlock();
        }
    }

private:
    // The functions that read are false if there is nothing more to be read.

    bool readBlock() {
        const auto type = m_reader.takeNext(4);
        const std::uint32_t number = type ? m_reader.read32(type->data()) : 0;
        if (number == kSectionHeader) {
            return readSectionHeader();
        }
        const auto length = type ? m_reader.take(4) : std::nullopt;
        return length && readBody(number, m_reader.read32(length->data()), 8);
    }

    /// A new section: byte order and interfaces are its own.
    bool readSectionHeader() {
        const auto start = m_reader.take(8);
        if (!start) {
            return false;
        }
        const std::uint32_t order = wire::load32(start->data() + 4);
        if (order != 0x1a2b3c4dU && order != 0x4d3c2b1aU) {
            m_reader.reportDamage("no byte order");
            return false;
        }
        m_reader.bigEndian = order == 0x1a2b3c4dU;
        m_interfaces.clear();
        return readBody(0, m_reader.read32(start->data()), 12);
    }

    /// What is left of a block of `length` bytes after the first `taken`.
    bool readBody(std::uint32_t type, std::uint32_t length, std::uint32_t taken) {
        if (length < taken + 4 || length % 4 != 0 || length > kLongestBlock) {
            m_reader.reportDamage("a block of impossible length");
            return false;
        }
        const auto rest = m_reader.take(length - taken);
        if (!rest) {
            return false;
        }
        const auto body = rest->first(rest->size() - 4); // the length is repeated at the end
        switch (static_cast<PcapngBlockType>(type)) {
        case PcapngBlockType::Interface:
            addInterface(body);
            break;
        case PcapngBlockType::SimplePacket:
            visitSimple(body);
            break;
        case PcapngBlockType::EnhancedPacket:
            visitEnhanced(body);
            break;
        case PcapngBlockType::InterfaceStatistics:
            visitStatistics(body);
            break;
        default:
            break;
        }
        return true;
    }

    void addInterface(Bytes body) {
        Interface interface;
        if (body.size() >= 8) {
            interface.linkType = m_reader.read16(body.data());
            interface.snapLength = m_reader.read32(body.data() + 4);
            visitOptions(body.subspan(8), [&](PcapngOption code, Bytes value) {
                if (code == PcapngOption::StampResolution && !value.empty()) {
                    interface.resolution = std::to_integer<std::uint8_t>(value[0]);
                } else if (code == PcapngOption::StampOffset && value.size() >= 8) {
                    interface.offsetSeconds = static_cast<std::int64_t>(read64(value.data()));
                }
            });
        }
        m_interfaces.push_back(interface);
    }

    [[nodiscard]] std::uint64_t read64(const std::byte* from) const {
        const std::uint64_t first = m_reader.read32(from);
        const std::uint64_t second = m_reader.read32(from + 4);
        return m_reader.bigEndian ? first << 32 | second : second << 32 | first;
    }

    template <class Visitor>
    void visitOptions(Bytes options, Visitor&& visitor) const {
        while (options.size() >= 4) {
            const auto code = static_cast<PcapngOption>(m_reader.read16(options.data()));
            const std::size_t length = m_reader.read16(options.data() + 2);
            const auto value = options.subspan(4);
            if (code == PcapngOption::End || value.size() < length) {
                return;
            }
            visitor(code, value.first(length));
            options = value.subspan(std::min(value.size(), (length + 3) / 4 * 4));
        }
    }

    /// How much was captured only the original length, the snap length and the block say together.
    void visitSimple(Bytes body) {
        m_notes.setComments({});
        if (body.size() >= 4 && !m_interfaces.empty()) {
            const Interface& interface = m_interfaces.front();
            std::size_t size = std::min<std::size_t>(m_reader.read32(body.data()), body.size() - 4);
            if (interface.snapLength != 0) {
                size = std::min<std::size_t>(size, interface.snapLength);
            }
            m_reassembly.add(
                {interface.linkType, body.subspan(4, size), m_reader.offset() + 4, std::nullopt});
        }
    }

    void visitEnhanced(Bytes body) {
        const std::size_t fixed = 20;
        if (body.size() < fixed || m_reader.read32(body.data()) >= m_interfaces.size()) {
            return;
        }
        const Interface& interface = m_interfaces[m_reader.read32(body.data())];
        const std::uint64_t stamp =
            std::uint64_t{m_reader.read32(body.data() + 4)} << 32 | m_reader.read32(body.data() + 8);
        const std::size_t size =
            std::min<std::size_t>(m_reader.read32(body.data() + 12), body.size() - fixed);
        readNotes(body.subspan(std::min(body.size(), fixed + (size + 3) / 4 * 4)));
        const CapturedFrame frame{interface.linkType, body.subspan(fixed, size), m_reader.offset() + fixed,
                                  near(timeOf(stamp, interface))};
        if (m_notes.isOfRecording()) {
            m_reassembly.addRecorded(frame);
        } else {
            m_reassembly.add(frame);
        }
    }

    void visitStatistics(Bytes body) const {
        constexpr std::size_t fixed = 12;
        if (!m_visitNotes || body.size() < fixed || m_reader.read32(body.data()) != 0) {
            return; // a recording notes all on its first interface
        }
        std::vector<std::string_view> notes;
        visitOptions(body.subspan(fixed), [&notes](PcapngOption code, Bytes value) {
            if (code == PcapngOption::Comment) {
                notes.push_back(textOf(value));
            }
        });
        m_visitNotes(notes);
    }

    /// Nothing for a time that is further than half of what a duration holds from the first one.
    std::optional<WallTime> near(std::optional<WallTime> time) {
        m_first = m_first ? m_first : time;
        if (!time) {
            return std::nullopt;
        }
        const auto [least, most] = std::minmax({nanosecondsOf(*time), nanosecondsOf(*m_first)});
        const std::uint64_t distance = static_cast<std::uint64_t>(most) - static_cast<std::uint64_t>(least);
        return distance <= std::uint64_t{1} << 62U ? time : std::nullopt;
    }

    void readNotes(Bytes options) {
        std::vector<std::string> comments;
        visitOptions(options, [&](PcapngOption code, Bytes value) {
            if (code == PcapngOption::Comment) {
                comments.emplace_back(textOf(value));
            } else if (code == PcapngOption::DropCount && value.size() >= 8) {
                m_notes.addDrops(read64(value.data()));
            }
        });
        m_notes.setComments(std::move(comments));
    }

    PieceReader& m_reader;
    Reassembly& m_reassembly;
    FrameNotes& m_notes;
    const NotesVisitor& m_visitNotes;
    std::vector<Interface> m_interfaces;
    std::optional<WallTime> m_first; ///< of the file
};

tl::expected<void, FileError> readCapture(ByteSource& source, std::uint32_t magic, const FileVisitor& visit,
                                          const NotesVisitor& visitNotes, FileContents& held) {
    FrameNotes notes;
    const FileVisitor noted = [&](const FileRecord& record) {
        FileRecord complete = record;
        notes.apply(complete);
        forEachDatagram(record.bytes, complete.flags,
                        [&](std::size_t from, std::size_t size, PacketFlags flags) {
                            complete.offset = record.offset + from;
                            complete.bytes = record.bytes.subspan(from, size);
                            complete.flags = flags;
                            visit(complete);
                            complete.kernelDropsBefore = 0;
                        });
    };
    Reassembly reassembly(noted);
    PieceReader reader(source);
    if (magic == kSectionHeader) {
        PcapngReader(reader, reassembly, notes, visitNotes).read();
    } else {
        readPcap(reader, magic, reassembly);
    }
    notes.setComments({});
    reassembly.finish();
    held.capture = reassembly.contents();
    return reader.result();
}

/// `front` has been read to find out the format.
tl::expected<void, FileError> readRaw(ByteSource& source, Bytes front, const FileVisitor& visit) {
    TcpFramer framer;
    const TcpFramer::Visitor pass = [&](const TcpFramer::Piece& piece) {
        visit({.offset = piece.offset,
               .bytes = piece.bytes,
               .flags = {.skipped = piece.kind == TcpFramer::Kind::Skipped}});
    };
    framer.push(front, pass);
    std::vector<std::byte> buffer(std::size_t{64} << 10);
    auto count = source.read(buffer);
    while (count && *count != 0) {
        framer.push(std::span(buffer).first(*count), pass);
        count = source.read(buffer);
    }
    framer.finish(pass);
    return count ? tl::expected<void, FileError>() : tl::unexpected(count.error());
}

} // namespace

tl::expected<void, FileError> readFile(ByteSource& source, const FileVisitor& visit,
                                       const NotesVisitor& visitNotes, FileContents* contents) {
    std::array<std::byte, 4> first{};
    const auto count = readFully(source, first);
    if (!count) {
        return tl::unexpected(count.error());
    }
    FileContents unasked;
    FileContents& held = contents != nullptr ? *contents : unasked;
    held = {};
    const FileVisitor counted = [&](const FileRecord& record) {
        held.count(record.bytes, record.flags.skipped);
        visit(record);
    };
    const std::uint32_t magic = *count == first.size() ? wire::load32(first.data()) : 0;
    const bool isPcap = std::ranges::find(kPcapMagics, magic) != kPcapMagics.end();
    held.isEmpty = *count == 0;
    return isPcap || magic == kSectionHeader ? readCapture(source, magic, counted, visitNotes, held)
                                             : readRaw(source, std::span(first).first(*count), counted);
}

} // namespace posewire::log
