// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/raw_file_import.h"

#include "core/log/raw_file.h"
#include "core/wire/header.h"

#include <QCoreApplication>
#include <QFileInfo>

#include <optional>
#include <vector>

namespace posewire::gui {

namespace {

constexpr std::int64_t kNsPerMs = 1'000'000;
/// Longer jumps of the time code are taken for a new beginning.
constexpr std::int64_t kGreatestStepNs = 10'000 * kNsPerMs;

struct Record {
    std::size_t offset;
    std::size_t size;
    std::int64_t stampNs;
    bool isSkipped;
};

/// All of a file, with stamps that begin at 0.
struct Recording {
    std::vector<std::byte> bytes;
    std::vector<Record> records;
    std::int64_t endNs = 0;
    std::optional<std::uint32_t> timeCode;

    void add(const log::FileRecord& record) {
        const auto header = wire::decodeHeader(record.bytes);
        if (!record.isSkipped && header) {
            const std::int64_t step =
                timeCode ? (static_cast<std::int64_t>(header->timeCode) - *timeCode) * kNsPerMs : 0;
            endNs += step > 0 && step <= kGreatestStepNs ? step : 0;
            timeCode = header->timeCode;
        }
        records.push_back({bytes.size(), record.bytes.size(), endNs, record.isSkipped});
        bytes.insert(bytes.end(), record.bytes.begin(), record.bytes.end());
    }
};

} // namespace

QString importRawFile(const QString& path, log::PacketLog& log, std::int64_t endNs) {
    const auto source = log::openFile(path.toStdString());
    if (!source) {
        return QString::fromStdString(source.error().text);
    }
    Recording recording;
    const auto read = log::readFile(**source, [&](const log::FileRecord& record) { recording.add(record); });
    if (!read) {
        return QString::fromStdString(read.error().text);
    }
    if (recording.records.empty()) {
        return QCoreApplication::translate("RawFileImport", "%1 is empty.").arg(path);
    }
    const log::SourceId id =
        log.sources().intern({QFileInfo(path).fileName().toStdString(), log::Transport::File, 0});
    for (const Record& record : recording.records) {
        log::Arrival arrival;
        arrival.stampNs = endNs - recording.endNs + record.stampNs;
        arrival.source = id;
        arrival.flags.skipped = record.isSkipped;
        log.writer().append(std::span(recording.bytes).subspan(record.offset, record.size), arrival);
    }
    log.writer().publish();
    return {};
}

} // namespace posewire::gui
