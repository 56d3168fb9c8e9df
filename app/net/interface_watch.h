// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/kernel_socket.h"

namespace posewire::net {

/// Hears from Linux that interfaces or their addresses have changed, without asking for them.
class InterfaceWatch {
public:
    InterfaceWatch();

    /// Readable when something has changed; -1 where the system tells nothing.
    [[nodiscard]] int descriptor() const { return m_socket.get(); }

    /// Whether something has changed since the last call. One system call, which does not block.
    [[nodiscard]] bool hasChanged();

private:
    Descriptor m_socket;
};

} // namespace posewire::net
