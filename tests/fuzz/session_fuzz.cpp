// SPDX-License-Identifier: MIT
#include "core/export/formats.h"
#include "core/export/reports.h"
#include "core/log/packet_log.h"
#include "core/log/recording_file.h"
#include "core/model/accounting/attribution.h"
#include "core/model/body/null_pose_findings.h"
#include "core/model/incidents/incident_follower.h"
#include "core/model/session/session.h"

#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <sstream>

// Whatever bytes a file has: it is read as a capture, followed by a session, looked at from several cursors,
// and written as every report there is. No packet is lost on the way, and every loss has one cause.
namespace {

using namespace posewire;

void require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

/// How many records it has.
std::uint64_t readInto(log::PacketLog& log, const std::uint8_t* data, std::size_t size) {
    std::istringstream bytes(std::string(reinterpret_cast<const char*>(data), size));
    const auto source = log::readingFrom(bytes, "input");
    std::uint64_t records = 0;
    log::RecordedClock clock(log.timeline());
    // What cannot be read further is an error that says so: what came before counts.
    static_cast<void>(log::readFile(*source, [&](const log::FileRecord& record) {
        const log::SenderId sender =
            log.senders().intern(record.sender.value_or(log::SenderInfo{"input", log::Transport::File, 0}));
        ++records;
        const log::Stamp stamp = record.time ? clock.stampOf(*record.time, record.setBy)
                                             : log::Stamp(std::chrono::milliseconds(records));
        log.writer().append(record.bytes, log::arrivalOf(record, sender, stamp));
    }));
    log.writer().publish();
    return records;
}

void checkCounts(const model::SessionView& session, std::uint64_t records) {
    require(session.end() == records && session.overtaken() == 0);
    std::uint64_t datagrams = 0;
    std::uint64_t malformed = 0;
    for (const model::Sender& sender : session.senders()) {
        datagrams += sender.datagrams;
        malformed += sender.malformed + sender.foreign;
        require(sender.malformed + sender.foreign <= sender.datagrams);
    }
    const model::SenderTotals all = session.allSenders();
    require(all.datagrams <= records && datagrams + session.retired().datagrams == all.datagrams);
    require(malformed + session.retired().malformed + session.retired().foreign ==
            all.malformed + all.foreign);
    for (const model::Stream& stream : session.streams()) {
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
        for (const model::Character& character : session.characters()) {
            static_cast<void>(session.pose(character.key));
            static_cast<void>(session.verdict(character.key));
            static_cast<void>(session.displayName(character.key));
            static_cast<void>(session.nullPoseEvidence(character.key));
            for (const model::Stream* stream : character.streams) {
                static_cast<void>(session.message(character.key, stream->key.type));
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
    for (const model::Incident& event : session.incidents().all()) {
        events.push_back(&event);
    }
    for (const auto& format : exporting::formats<exporting::EventSheet>()) {
        require(!format.write({session, events}).empty());
    }
    for (const model::Character& character : session.characters()) {
        for (const auto& format : exporting::formats<exporting::NullPoseSheet>()) {
            require(
                !format.write({session.displayName(character.key), session.nullPose(character.key)}).empty());
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    log::PacketLog log({.memoryCap = std::size_t{64} << 20, .chunkSize = std::size_t{1} << 20});
    model::Session session(log);
    const std::uint64_t records = readInto(log, data, size);
    while (session.followFile({})) {
    }
    session.endFile();
    checkCounts(session, records);
    lookAround(session, records);
    write(session);
    return 0;
}
