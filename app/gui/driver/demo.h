// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/driver/receiving.h"

#include <QObject>

#include <thread>

namespace posewire::gui {

/// The performer as a sender beside the window.
class Demo final : public QObject {
    Q_OBJECT

public:
    explicit Demo(Receiving& receiving) : m_receiving(receiving) {}

    /// Sends this many characters to a port of this computer, through a real socket; 0 ends that.
    void setCharacters(int characters);
    [[nodiscard]] bool isRunning() const { return m_thread.joinable(); }

signals:
    void changed();

private:
    Receiving& m_receiving;
    std::jthread m_thread;
};

} // namespace posewire::gui
