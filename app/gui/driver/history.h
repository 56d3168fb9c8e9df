// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/disk_history.h"
#include "core/log/packet_log.h"
#include "core/log/pcapng_writer.h"

#include <QCoreApplication>
#include <QString>

#include <cstdint>
#include <memory>
#include <vector>

namespace posewire::gui {

[[nodiscard]] log::RecordingInfo writtenByUs();

/// For what a log keeps of each packet, in a folder that is made if it is missing; in memory without one.
[[nodiscard]] std::shared_ptr<log::Scratch> scratchIn(const QString& folder);

/// Keeps what is received on the disk, too, so that it can be looked back at when memory has dropped it; and
/// what earlier runs have left of theirs.
class History {
    Q_DECLARE_TR_FUNCTIONS(History)

public:
    /// The log must outlive it. Without a folder, only what is in memory can be looked back at.
    History(log::PacketLog& log, QString folder) : m_log(log), m_folder(std::move(folder)) {}

    /// Keeps as many bytes at most, and no more than a tenth of what is free; 0 for none. What was kept
    /// before goes. Returns why it cannot; empty if it can.
    QString keep(std::uint64_t most);
    /// Keeps the files beyond the end of the program: the next run offers them.
    void leave() {
        if (m_onDisk) {
            m_onDisk->leave();
        }
    }
    /// Null while none is kept.
    [[nodiscard]] const log::DiskHistory* onDisk() const { return m_onDisk.get(); }
    [[nodiscard]] const QString& folder() const { return m_folder; }

    /// What earlier runs that did not end well have left of theirs, the oldest first.
    [[nodiscard]] std::vector<log::LostHistory> lost() const;
    void discardLost();

private:
    log::PacketLog& m_log;
    const QString m_folder; ///< empty for none
    std::unique_ptr<log::DiskHistory> m_onDisk;
};

} // namespace posewire::gui
