// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/mvnx/mvnx_source.h"

#include "core/log/memory_sink.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace posewire::mvnx {
namespace {

using Result = tl::expected<void, log::FileError>;

std::string_view textOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// From the first byte that is neither a byte order mark nor blank.
std::string_view contentOf(std::span<const std::byte> head) {
    const std::string_view text = textOf(head);
    const std::size_t mark = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
    return text.substr(std::min(text.find_first_not_of(" \t\r\n", mark), text.size()));
}

} // namespace

bool isMvnx(std::span<const std::byte> head) {
    const std::string_view text = contentOf(head.first(std::min(head.size(), kLookedAt)));
    return text.starts_with('<') && text.find("<mvnx") != std::string_view::npos;
}

class MvnxSource::Reader {
public:
    Reader(std::string_view head, log::ByteSource& rest, std::vector<std::byte>& into)
        : m_xml(head, rest), m_sink(into), m_writer(m_sink) {
        static_cast<void>(m_writer.begin({})); // memory takes everything
        const std::string path = rest.name();
        m_sender = {path.substr(path.find_last_of("/\\") + 1), log::Transport::File, 0};
    }

    /// Writes the datagrams of the next frame; false at the end of the file.
    tl::expected<bool, log::FileError> next() {
        while (true) {
            const auto event = m_xml.next();
            if (!event) {
                return tl::unexpected(event.error());
            }
            if (*event == XmlReader::Event::EndOfFile) {
                return m_frames != 0 ? tl::expected<bool, log::FileError>(false)
                                     : tl::unexpected(m_xml.damage("the file ends without a frame"));
            }
            const bool isBegin = *event == XmlReader::Event::Begin;
            if (const auto taken = isBegin ? begins() : ends(); !taken) {
                return tl::unexpected(taken.error());
            }
            if (!isBegin && m_xml.name() == "frame" && m_frame.isNormal()) {
                write();
                return true;
            }
        }
    }

private:
    Result begins() {
        if (m_xml.name() == "subject") {
            if (++m_subjects > kMostSubjects) {
                return tl::unexpected(
                    m_xml.damage("more than " + std::to_string(kMostSubjects) + " subjects"));
            }
            m_subject = {};
            m_frame = {};
            m_nullPose.clear();
            m_nextDescription = 0;
            m_origin.reset();
        }
        return m_xml.name() == "frame" ? m_frame.begins(m_xml, m_subject.rateHz) : m_subject.begins(m_xml);
    }

    Result ends() {
        if (m_xml.name() == "frame" && m_frame.isNullPose() && m_nullPose.empty()) {
            const auto places = m_frame.field(Frame::Position);
            m_nullPose.assign(places.begin(), places.end());
        }
        const Result read = m_frame.ends(m_xml, m_subject);
        return read ? m_subject.ends(m_xml) : read;
    }

    void write() {
        const auto character = static_cast<std::uint8_t>(m_subjects - 1);
        const log::Stamp stamp = stampOf();
        const TakeDatagram take = [&](std::span<const std::byte> bytes) {
            static_cast<void>(m_writer.add({m_packets++, stamp, {}, 0, {}, bytes}, m_sender));
        };
        if (m_frame.index >= m_nextDescription) {
            m_nextDescription = m_frame.index + static_cast<std::uint64_t>(std::ceil(m_subject.rateHz));
            m_frame.sendDescription(m_subject, character, m_nullPose, take);
        }
        m_frame.send(m_subject, character, take);
        ++m_frames;
    }

    /// By the frame rate, from the first frame on.
    log::Stamp stampOf() {
        constexpr std::int64_t kLatestMs = 4'102'444'800'000; // 2100
        if (!m_origin) {
            const std::int64_t ms = m_frame.epochMs.value_or(m_subject.begin.value_or(0));
            m_origin = {m_frame.index, std::chrono::milliseconds(std::clamp<std::int64_t>(ms, 0, kLatestMs))};
        }
        const double seconds = (m_frame.index - m_origin->first) / m_subject.rateHz;
        return log::Stamp(m_origin->second + std::chrono::round<log::Duration>(
                                                 std::chrono::duration<double>(std::min(seconds, 1e9))));
    }

    static constexpr unsigned kMostSubjects = 64;

    XmlReader m_xml;
    log::MemorySink m_sink;
    log::PcapngWriter m_writer;
    log::SenderInfo m_sender;
    Subject m_subject;
    Frame m_frame;
    std::vector<float> m_nullPose; ///< origin of each segment; empty if there is none
    unsigned m_subjects = 0;
    std::uint64_t m_nextDescription = 0;                             ///< index of the frame that it goes with
    std::optional<std::pair<std::uint32_t, log::Duration>> m_origin; ///< index and time of the first frame
    std::uint64_t m_frames = 0;
    std::uint64_t m_packets = 0;
};

MvnxSource::MvnxSource(std::unique_ptr<log::ByteSource> source) : m_source(std::move(source)) {}
MvnxSource::~MvnxSource() = default;

Result MvnxSource::begin() {
    m_ready.resize(kLookedAt);
    std::size_t size = 0;
    bool mayBeXml = true;
    for (std::size_t count = 1; count != 0 && size < kLookedAt && mayBeXml; size += count) {
        const auto read = m_source->read(std::span(m_ready).subspan(size));
        if (!read) {
            return tl::unexpected(read.error());
        }
        count = *read;
        const std::string_view text = contentOf(std::span(m_ready).first(size + count));
        mayBeXml = text.empty() || text.starts_with('<');
    }
    m_ready.resize(size);
    m_hasBegun = true;
    if (isMvnx(m_ready)) {
        const std::vector<std::byte> head = std::exchange(m_ready, {});
        m_reader = std::make_unique<Reader>(contentOf(head), *m_source, m_ready);
    }
    return {};
}

tl::expected<std::size_t, log::FileError> MvnxSource::read(std::span<std::byte> into) {
    if (!m_hasBegun) {
        if (const Result begun = begin(); !begun) {
            return tl::unexpected(begun.error());
        }
    }
    while (m_given == m_ready.size()) { // a frame may have no values
        m_ready.clear();
        m_given = 0;
        if (!m_reader) {
            return m_source->read(into);
        }
        if (const auto more = m_reader->next(); !more || !*more) {
            return more ? tl::expected<std::size_t, log::FileError>(0) : tl::unexpected(more.error());
        }
    }
    const std::size_t count = std::min(into.size(), m_ready.size() - m_given);
    std::copy_n(m_ready.begin() + static_cast<std::ptrdiff_t>(m_given), count, into.begin());
    m_given += count;
    return count;
}

tl::expected<std::unique_ptr<log::ByteSource>, log::FileError> openFile(const std::string& path,
                                                                        log::IsCancelled isCancelled) {
    auto file = log::openFile(path, std::move(isCancelled));
    if (!file) {
        return file;
    }
    return std::make_unique<MvnxSource>(std::move(*file));
}

} // namespace posewire::mvnx
