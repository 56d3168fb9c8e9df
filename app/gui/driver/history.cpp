// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/history.h"

#include "app/gui/base/logging.h"
#include "core/log/file_names.h"
#include "core/log/output_file.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace posewire::gui {

namespace {

std::uint64_t freeBytes(const QString& folder) {
    // QStorageInfo fails if the table of mounts lacks the root, as in a chroot.
    std::error_code failed;
    const auto space = std::filesystem::space(log::pathOf(folder.toStdString()), failed);
    return failed ? 0 : space.available;
}

/// The most that something of ours takes in a folder.
std::uint64_t tenthOfFree(const QString& folder) {
    return freeBytes(folder) / 10;
}

} // namespace

log::RecordingInfo writtenByUs() {
    const QString application =
        QCoreApplication::applicationName() + u' ' + QCoreApplication::applicationVersion();
    return {{}, {}, application.toStdString()};
}

std::shared_ptr<log::Scratch> scratchIn(const QString& folder) {
    if (folder.isEmpty() || !log::makeFolder(folder.toStdString())) {
        return std::make_shared<log::Scratch>();
    }
    return std::make_shared<log::Scratch>(folder.toStdString(), tenthOfFree(folder));
}

std::vector<log::LostHistory> History::lost() const {
    return m_folder.isEmpty() ? std::vector<log::LostHistory>() : log::lostHistories(m_folder.toStdString());
}

void History::discardLost() {
    log::discardHistories(m_folder.toStdString(), 0);
}

QString History::keep(std::uint64_t most) {
    m_onDisk.reset();
    log::discardHistories(m_folder.toStdString(), most);
    if (most == 0 || m_folder.isEmpty()) {
        return {};
    }
    if (!m_log.scratch()->hasFile()) { // what is kept of each packet would grow in memory
        return tr("There is no room for scratch files in %1: only what is in memory can be looked back at.")
            .arg(m_folder);
    }
    const log::DiskHistoryChoice choice{m_folder.toStdString(), std::min(most, tenthOfFree(m_folder))};
    if (freeBytes(m_folder) < choice.leaveFree) {
        return tr("Less than 1 GB is free on the disk of %1: only what is in memory can be looked back at.")
            .arg(m_folder);
    }
    auto history = log::DiskHistory::start(m_log, choice, writtenByUs());
    if (!history) {
        return QString::fromStdString(history.error().text);
    }
    m_onDisk = std::move(*history);
    qCInfo(filesLog).noquote() << "history in" << m_folder << "of at most" << choice.most << "bytes";
    return {};
}

} // namespace posewire::gui
