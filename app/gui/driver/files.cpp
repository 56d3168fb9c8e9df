// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/files.h"

#include "app/gui/base/logging.h"
#include "core/model/session/verdict.h"

#include <cmath>

namespace posewire::gui {

Files::Files(Commands& commands, const log::Clock& clock, const QString& cacheFolder)
    : m_commands(commands),
      m_clock(clock),
      m_cacheFolder(cacheFolder),
      m_comparing(commands, clock, cacheFolder) {}

void Files::open(const QString& path) {
    close();
    qCInfo(filesLog).noquote() << "opening" << path;
    m_file = std::make_unique<OpenedFile>(m_clock, path, m_cacheFolder);
    m_file->session().setUsual(m_commands.usual());
    m_file->session().setThresholds(m_commands.live().verdicts().thresholds());
}

bool Files::follow(log::Duration most) {
    const bool hasRead = isReading() && read(most);
    return m_comparing.follow(most) || hasRead;
}

bool Files::read(log::Duration most) {
    const bool isFirst = m_file->session().end() == 0;
    const bool hasNew = m_file->follow(most);
    if (hasNew && isFirst) {
        show();
    }
    if (const QString failure = m_file->failure(); !failure.isEmpty()) {
        qCInfo(filesLog).noquote() << "not opened:" << failure;
        close();
        emit opened(false, failure);
    } else if (!m_file->isReading()) {
        qCInfo(filesLog) << "read," << m_file->session().end() << "packets";
        emit opened(true, m_file->notes().join(QLatin1Char(' ')));
    }
    return hasNew && m_commands.isFileShown();
}

QString Files::openingText() const {
    const OpenedFile* file = isReading() ? m_file.get() : m_comparing.file();
    return isOpening() ? tr("Opening %1: %2 %").arg(file->name()).arg(std::floor(100 * file->share()))
                       : QString();
}

void Files::cancelOpening() {
    if (!isReading()) {
        m_comparing.stopReading();
        return;
    }
    m_file->stop();
    const QString text = m_file->notes().join(QLatin1Char(' '));
    if (m_file->session().end() == 0) {
        close();
    } else {
        show();
    }
    emit opened(false, text);
}

void Files::show() {
    if (m_file != nullptr && m_file->session().end() != 0) {
        m_commands.show(m_file->session());
    }
}

void Files::close() {
    if (m_file != nullptr) {
        m_commands.showLive();
        emit closing();
        m_comparing.endOf(m_file->session().log());
        m_file.reset();
    }
}

} // namespace posewire::gui
