// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/receive_loop.h"

#include "app/net/qt_receive_loop.h"
#ifdef __linux__
#include "app/net/recvmmsg_loop.h"
#endif

namespace posewire::net {

std::unique_ptr<ReceiveLoop> makeReceiveLoop(const ReceiveContext& context) {
#ifdef __linux__
    if (context.options.path == ReceivePath::Native) {
        return makeRecvmmsgLoop(context);
    }
#endif
    return makeQtReceiveLoop(context);
}

} // namespace posewire::net
