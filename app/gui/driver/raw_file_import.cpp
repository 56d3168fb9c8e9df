// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/raw_file_import.h"

#include "core/log/recording_file.h"
#include "core/log/time.h"
#include "core/wire/header.h"

#include <QCoreApplication>
#include <QFileInfo>

#include <optional>

namespace posewire::gui {

namespace {

/// Longer jumps of the time code are taken for a new beginning.
constexpr log::Duration kGreatestStep = std::chrono::seconds(10);

/// Time within a raw file, told by its time codes, from 0.
class TimeCodeStamps {
public:
    log::Duration next(const log::FileRecord& record) {
        const auto header = wire::decodeHeader(record.bytes);
        if (!record.flags.skipped && header) {
            const auto timeCode = static_cast<std::int64_t>(header->timeCode);
            const log::Duration step = std::chrono::milliseconds(m_timeCode ? timeCode - *m_timeCode : 0);
            m_time += step > log::Duration::zero() && step <= kGreatestStep ? step : log::Duration::zero();
            m_timeCode = header->timeCode;
        }
        return m_time;
    }

private:
    log::Duration m_time{};
    std::optional<std::uint32_t> m_timeCode;
};

/// Reads a file from its beginning to its end.
QString visitFile(const QString& path, const log::FileVisitor& visit) {
    const auto source = log::openFile(path.toStdString());
    if (!source) {
        return QString::fromStdString(source.error().text);
    }
    const auto read = log::readFile(**source, visit);
    return read ? QString() : QString::fromStdString(read.error().text);
}

} // namespace

QString importRawFile(const QString& path, const PacketTaker& take, log::Stamp end) {
    // Twice over: how long a raw file lasts is known at its end, and it may be larger than memory.
    TimeCodeStamps measuring;
    log::Duration length{};
    std::uint64_t count = 0;
    QString problem = visitFile(path, [&](const log::FileRecord& record) {
        length = measuring.next(record);
        ++count;
    });
    if (!problem.isEmpty() || count == 0) {
        return problem.isEmpty() ? QCoreApplication::translate("RawFileImport", "%1 is empty.").arg(path)
                                 : problem;
    }
    const log::SenderInfo file{QFileInfo(path).fileName().toStdString(), log::Transport::File, 0};
    TimeCodeStamps stamps;
    return visitFile(path, [&](const log::FileRecord& record) {
        const log::Stamp stamp = end - length + stamps.next(record);
        take(record.bytes, record.sender.value_or(file), log::arrivalOf(record, {}, stamp));
    });
}

} // namespace posewire::gui
