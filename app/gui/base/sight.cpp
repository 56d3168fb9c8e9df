// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/sight.h"

#include <QGuiApplication>
#include <QWindow>

#ifdef POSEWIRE_XCB
#include <QAbstractNativeEventFilter>

#include <xcb/xcb.h>

#include <cstdlib>
#include <memory>
#include <set>
#endif

namespace posewire::gui {
namespace {

#ifdef POSEWIRE_XCB
/// Windows on an X server that others cover: Qt does not ask for that.
class CoveredWindows final : public QAbstractNativeEventFilter {
public:
    CoveredWindows() { QCoreApplication::instance()->installNativeEventFilter(this); }

    /// Starts to watch a window when first called for it, so only later calls can return true.
    bool watchFor(const QWindow& window) {
        const auto id = static_cast<xcb_window_t>(window.winId());
        if (m_watched.insert(id).second) {
            watch(id);
        }
        return m_covered.count(id) != 0;
    }

    bool nativeEventFilter(const QByteArray& /*type*/, void* message, qintptr* /*result*/) override {
        constexpr unsigned kSent = 0x80; // by another program
        const auto* event = static_cast<const xcb_generic_event_t*>(message);
        if ((event->response_type & ~kSent) == XCB_VISIBILITY_NOTIFY) {
            const auto* seen = static_cast<const xcb_visibility_notify_event_t*>(message);
            if (seen->state == XCB_VISIBILITY_FULLY_OBSCURED) {
                m_covered.insert(seen->window);
            } else {
                m_covered.erase(seen->window);
            }
        }
        return false;
    }

private:
    static void watch(xcb_window_t id) {
        xcb_connection_t* server =
            qGuiApp->nativeInterface<QNativeInterface::QX11Application>()->connection();
        const std::unique_ptr<xcb_get_window_attributes_reply_t, decltype(&std::free)> now(
            xcb_get_window_attributes_reply(server, xcb_get_window_attributes(server, id), nullptr),
            &std::free);
        if (now != nullptr) {
            const std::uint32_t events = now->your_event_mask | XCB_EVENT_MASK_VISIBILITY_CHANGE;
            xcb_change_window_attributes(server, id, XCB_CW_EVENT_MASK, &events);
        }
    }

    std::set<xcb_window_t> m_watched;
    std::set<xcb_window_t> m_covered;
};

bool isCovered(const QWindow& window) {
    static auto* const covered = QGuiApplication::platformName() == QLatin1String("xcb")
                                     ? new CoveredWindows // until the program ends
                                     : nullptr;
    return covered != nullptr && covered->watchFor(window);
}
#else
bool isCovered(const QWindow& /*window*/) {
    return false;
}
#endif

} // namespace

bool isAnyWindowInSight() {
    bool isAny = false;
    for (const QWindow* window : QGuiApplication::topLevelWindows()) {
        const bool isMinimized = window->windowStates().testFlag(Qt::WindowMinimized);
        if (window->isExposed() && !isMinimized && !isCovered(*window)) {
            return true;
        }
        isAny = isAny || window->isVisible();
    }
    return !isAny;
}

} // namespace posewire::gui
