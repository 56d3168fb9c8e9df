// SPDX-License-Identifier: MIT
#include "core/export/formats.h"
#include "core/export/motion/motion_export.h"
#include "core/export/reports.h"
#include "core/log/packet_log.h"
#include "core/log/recording_file.h"
#include "core/model/accounting/attribution.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/body/null_pose_findings.h"
#include "core/model/incidents/incident_follower.h"
#include "core/model/session/accounts.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/model/session/session.h"
#include "core/model/session/verdict.h"
#include "tests/support/stream_source.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <sstream>

// Whatever bytes a file has: it is read as a capture, followed by a session, looked at from several cursors,
// and written as every report and motion in every format there is. No packet is lost on the way, every loss
// has one cause, and what is read again from the file is what memory has.
namespace {

using namespace posewire;

void require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

class MemoryStore final : public log::ByteStore {
public:
    explicit MemoryStore(std::span<const std::uint8_t> bytes) : m_bytes(std::as_bytes(bytes)) {}
    [[nodiscard]] std::size_t readAt(std::uint64_t offset, std::span<std::byte> into) const override {
        const auto from = m_bytes.subspan(std::min<std::size_t>(offset, m_bytes.size()));
        const std::size_t size = std::min(from.size(), into.size());
        std::copy_n(from.begin(), size, into.begin());
        return size;
    }

private:
    std::span<const std::byte> m_bytes;
};

/// How many records it has. `past`: notes where they lie, as for a file that memory has no room for.
std::uint64_t readInto(log::PacketLog& log, log::PastWriter& past, const std::uint8_t* data,
                       std::size_t size) {
    std::istringstream bytes(std::string(reinterpret_cast<const char*>(data), size));
    const auto source = test::readingFrom(bytes, "input");
    std::uint64_t records = 0;
    log::RecordedClock clock(log.timeline());
    // What cannot be read further is an error that says so: what came before counts.
    static_cast<void>(log::readFile(*source, [&](const log::FileRecord& record) {
        const log::SenderId sender =
            log.senders().intern(record.sender.value_or(log::SenderInfo{"input", log::Transport::File, 0}));
        const log::Stamp stamp = record.time ? clock.stampOf(*record.time, record.setBy)
                                             : log::Stamp(std::chrono::milliseconds(records));
        const log::Arrival arrival = log::arrivalOf(record, sender, stamp);
        log.writer().append(record.bytes, arrival);
        if (record.isInOnePiece) {
            past.add(records, arrival, record.offset, record.bytes.size());
        } else {
            past.keep(records, arrival, record.bytes);
        }
        ++records;
    }));
    log.writer().publish();
    past.finish();
    return records;
}

/// In the file is what memory has, in whatever order it is asked for.
void checkPast(const log::PacketLog& log, const log::Past& past, std::uint64_t records) {
    log::LogReader memory(log);
    log::PastReader file(past);
    for (const std::uint64_t step :
         {std::uint64_t{1}, std::uint64_t{7}, records - 1}) { // forward, around, back
        std::uint64_t number = 0;
        for (std::uint64_t i = 0; i < records; ++i, number = (number + step) % records) {
            const auto kept = memory.packet(number);
            const auto read = file.packet(number);
            require(kept && read && std::ranges::equal(kept->bytes, read->bytes));
            require(kept->stamp == read->stamp && kept->sender == read->sender &&
                    kept->kernelDropsBefore == read->kernelDropsBefore && kept->flags == read->flags);
        }
    }
    require(!file.packet(records));
}

void checkCounts(const model::SessionView& session, std::uint64_t records) {
    require(session.end() == records && session.accounts().overtaken() == 0);
    std::uint64_t datagrams = 0;
    std::uint64_t malformed = 0;
    for (const model::Sender& sender : session.roster().senders()) {
        datagrams += sender.datagrams;
        malformed += sender.malformed + sender.foreign;
        require(sender.malformed + sender.foreign <= sender.datagrams);
    }
    const model::SenderTotals all = session.accounts().allSenders();
    require(all.datagrams <= records && datagrams + session.accounts().retired().datagrams == all.datagrams);
    require(malformed + session.accounts().retired().malformed + session.accounts().retired().foreign ==
            all.malformed + all.foreign);
    for (const model::Stream& stream : session.roster().streams()) {
        const model::StreamCounts counts = stream.accounting.counts();
        const auto causes = stream.lostByCause();
        require(std::accumulate(causes.begin(), causes.end(), std::uint64_t{0}) >=
                counts.lost + counts.incomplete);
    }
}

void lookAround(model::Session& session, std::uint64_t records) {
    for (const std::uint64_t packet : {std::uint64_t{0}, records / 2, records}) {
        if (packet < records) {
            session.setCursor({model::Cursor::Mode::Paused, packet});
        } else {
            session.setCursor({});
        }
        for (const model::Character& character : session.roster().characters()) {
            static_cast<void>(session.messages().pose(character.key));
            static_cast<void>(session.verdicts().of(character.key));
            static_cast<void>(session.roster().displayName(character.key));
            static_cast<void>(session.messages().nullPoseEvidence(character.key));
            for (const model::Stream* stream : character.streams) {
                static_cast<void>(session.messages().message(character.key, stream->key.type));
            }
        }
    }
}

void write(const model::Session& session) {
    require(!exporting::monitorReport(session, {}).empty());
    for (const auto& format : exporting::formats<exporting::ReportSheet>()) {
        require(!format.write({session, {}}).empty());
    }
    std::vector<const model::Incident*> events;
    for (const model::Incident& event : session.verdicts().incidents().all()) {
        events.push_back(&event);
    }
    for (const auto& format : exporting::formats<exporting::EventSheet>()) {
        require(!format.write({session, events}).empty());
    }
    for (const model::Character& character : session.roster().characters()) {
        for (const auto& format : exporting::formats<exporting::NullPoseSheet>()) {
            require(!format
                         .write({session.roster().displayName(character.key),
                                 session.messages().nullPose(character.key)})
                         .empty());
        }
    }
}

/// In every format; those that hold one character get them one after the other.
void exportMotion(const model::Session& session) {
    std::vector<std::vector<model::CharacterKey>> groups(1);
    for (const model::Character* character : session.atNow().roster().listed()) {
        groups.front().push_back(character->key);
        groups.push_back({character->key});
    }
    for (const exporting::MotionFormat& format : exporting::motionFormats()) {
        for (const auto& group : groups) {
            if (group.size() > 1 && !format.holdsSeveral) {
                continue;
            }
            const auto source = feed::poseSourceOf(session, model::kAllTime, group);
            const auto exported = exporting::exportMotion({source, format, "/dev/null"});
            require(exported.has_value() || !exported.error().text.empty());
            for (const exporting::ExportedMotion& one :
                 exported.value_or(std::vector<exporting::ExportedMotion>())) {
                require(one.frames > one.gaps && one.frames - one.gaps <= session.end());
            }
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    log::PacketLog log({.memoryCap = std::size_t{64} << 20, .chunkSize = std::size_t{1} << 20});
    model::Session session(log);
    log::Past past(std::make_shared<log::Scratch>());
    log::PastWriter writer(past, log.senders(), std::make_shared<MemoryStore>(std::span(data, size)));
    const std::uint64_t records = readInto(log, writer, data, size);
    checkPast(log, past, records);
    while (session.followFile({})) {
    }
    session.endFile();
    checkCounts(session, records);
    lookAround(session, records);
    write(session);
    exportMotion(session);
    return 0;
}
