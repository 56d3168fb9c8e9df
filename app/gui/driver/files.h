// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/driver/comparing.h"
#include "app/gui/driver/opened_file.h"

#include <QObject>

#include <memory>

namespace posewire::gui {

/// Recordings that are open: one that can be shown instead of what is received, and one that what is shown is
/// compared with.
class Files final : public QObject {
    Q_OBJECT

public:
    /// Commands and clock must outlive it.
    Files(Commands& commands, const log::Clock& clock, const QString& cacheFolder);

    /// Begins to read a file of datagrams, instead of one that is open; opened() says how it went. It is
    /// shown as soon as there is something of it.
    void open(const QString& path);
    /// Null if none is open.
    [[nodiscard]] OpenedFile* file() { return m_file.get(); }
    /// Shows the file that is open, if there is something of it.
    void show();
    void close();
    [[nodiscard]] Comparing& comparing() { return m_comparing; }

    /// Either of them is being read.
    [[nodiscard]] bool isOpening() const { return isReading() || m_comparing.isReading(); }
    /// Reads no further: what was read of the file is there, and opened() or the comparison says so.
    void cancelOpening();
    /// "Opening take.pcapng: 43 %"; empty if none is being read.
    [[nodiscard]] QString openingText() const;

    /// One display tick, for about as long as `most` each; true if there is something new to show.
    bool follow(log::Duration most);

signals:
    /// A file was read, or could not be. `text` is what is to be said about it, empty for nothing.
    void opened(bool isRead, const QString& text);
    /// The file's session goes after this, and must not be looked at any more.
    void closing();

private:
    [[nodiscard]] bool isReading() const { return m_file != nullptr && m_file->isReading(); }
    /// True if there was anything new of the file.
    bool read(log::Duration most);

    Commands& m_commands;
    const log::Clock& m_clock;
    const QString m_cacheFolder;
    std::unique_ptr<OpenedFile> m_file;
    Comparing m_comparing; ///< after the file, which it reads
};

} // namespace posewire::gui
