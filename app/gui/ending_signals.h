// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

#include <memory>

class QSocketNotifier;

namespace posewire::gui {

/// Ctrl+C (SIGINT), SIGTERM and SIGHUP as an event of the window's thread, so that it closes in good order; a
/// second one ends the program at once. A SIGHUP that is ignored stays so (nohup). One object at a time.
class EndingSignals final : public QObject {
    Q_OBJECT

public:
    explicit EndingSignals(QObject* parent = nullptr);
    ~EndingSignals() override;

signals:
    void requested();

private:
    std::unique_ptr<QSocketNotifier> m_notifier;
};

} // namespace posewire::gui
