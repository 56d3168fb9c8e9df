// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/raw_file_import.h"

#include "core/log/raw_file.h"
#include "core/log/time.h"
#include "core/wire/header.h"

#include <QCoreApplication>
#include <QFileInfo>

#include <optional>

namespace posewire::gui {

namespace {

/// Longer jumps of the time code are taken for a new beginning.
constexpr std::int64_t kGreatestStepNs = 10 * log::kSecondNs;

/// Time within a raw file, told by its time codes, from 0.
class TimeCodeStamps {
public:
    std::int64_t next(const log::FileRecord& record) {
        const auto header = wire::decodeHeader(record.bytes);
        if (!record.isSkipped && header) {
            const std::int64_t step =
                m_timeCode ? (static_cast<std::int64_t>(header->timeCode) - *m_timeCode) * log::kMillisecondNs
                           : 0;
            m_stampNs += step > 0 && step <= kGreatestStepNs ? step : 0;
            m_timeCode = header->timeCode;
        }
        return m_stampNs;
    }

private:
    std::int64_t m_stampNs = 0;
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

QString importRawFile(const QString& path, const PacketTaker& take, std::int64_t endNs) {
    // Twice over: how long a raw file lasts is known at its end, and it may be larger than memory.
    TimeCodeStamps measuring;
    std::int64_t lengthNs = 0;
    std::uint64_t count = 0;
    QString problem = visitFile(path, [&](const log::FileRecord& record) {
        lengthNs = measuring.next(record);
        ++count;
    });
    if (!problem.isEmpty() || count == 0) {
        return problem.isEmpty() ? QCoreApplication::translate("RawFileImport", "%1 is empty.").arg(path)
                                 : problem;
    }
    const log::SenderInfo file{QFileInfo(path).fileName().toStdString(), log::Transport::File, 0};
    TimeCodeStamps stamps;
    return visitFile(path, [&](const log::FileRecord& record) {
        const std::int64_t stampNs = endNs - lengthNs + stamps.next(record);
        take(record.bytes, record.sender.value_or(file), log::arrivalOf(record, {}, stampNs));
    });
}

} // namespace posewire::gui
