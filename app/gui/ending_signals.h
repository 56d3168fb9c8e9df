// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/system/ending_request.h"

#include <QObject>

namespace posewire::gui {

/// What asks the program to end (see system::EndingRequest) as an event of the window's thread, so that it
/// closes in good order. One object at a time.
class EndingSignals final : public QObject {
    Q_OBJECT

public:
    explicit EndingSignals(QObject* parent = nullptr);

signals:
    void requested();

private:
    system::EndingRequest m_request;
};

} // namespace posewire::gui
