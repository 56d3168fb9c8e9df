// SPDX-License-Identifier: GPL-3.0-or-later
// What is shown against a second recording.
#include "app/gui/base/logging.h"
#include "app/gui/base/saving.h"
#include "app/gui/driver/session_driver.h"

namespace posewire::gui {

namespace {

constexpr log::Duration kReadTime = std::chrono::milliseconds(8); // of each tick

} // namespace

void SessionDriver::compareWith(const QString& path) {
    qCInfo(filesLog).noquote() << "comparing with" << path;
    m_comparing.open(path, scratchOfFile());
    m_isChanged = true;
    m_tableTick = {};
    emit comparisonChanged({});
}

void SessionDriver::endComparison() {
    m_comparing.close();
    m_isChanged = true;
    m_tableTick = {};
    emit comparisonChanged({});
}

void SessionDriver::setComparison(const ComparisonChoice& choice) {
    m_comparing.choose(choice);
    m_isChanged = true;
    m_tableTick = {};
}

void SessionDriver::setComparing(bool isOn) {
    if (isOn) {
        m_comparing.workAgain();
    } else {
        m_comparing.stop();
    }
    m_tableTick = {};
}

void SessionDriver::saveComparison(const QString& path) {
    if (const QString problem = m_comparing.save(path, replacing()); !problem.isEmpty()) {
        emit comparisonChanged(problem);
    }
}

void SessionDriver::stopReadingCompared() {
    if (OpenedFile* file = m_comparing.file(); isReading(file)) {
        file->stop();
        const QString text = file->notes().join(QLatin1Char(' '));
        if (file->session().end() == 0) {
            m_comparing.close();
        }
        emit comparisonChanged(text);
    }
}

void SessionDriver::followComparison() {
    const bool wasReading = isReading(compared());
    m_isChanged = m_comparing.follow(shown(), kReadTime) || m_isChanged;
    if (compared() != nullptr && !compared()->failure().isEmpty()) {
        const QString problem = tr("Nothing to compare with: %1").arg(compared()->failure());
        m_comparing.close();
        m_isChanged = true;
        emit comparisonChanged(problem);
    } else if (wasReading && !isReading(compared())) {
        emit comparisonChanged({});
    }
    if (const auto saved = m_comparing.takeSaved()) {
        emit comparisonChanged(*saved);
    }
}

} // namespace posewire::gui
