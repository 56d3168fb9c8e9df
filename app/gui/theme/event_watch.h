// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QEvent>
#include <QWidget>

#include <functional>

namespace posewire::gui {

/// Calls back whenever a widget is about to get an event of one type, such as QEvent::PaletteChange for
/// colours of the theme that it keeps. Lives as long as the widget.
class EventWatch final : public QObject {
public:
    EventWatch(QWidget* widget, QEvent::Type type, std::function<void()> call)
        : QObject(widget), m_type(type), m_call(std::move(call)) {
        widget->installEventFilter(this);
    }

    bool eventFilter(QObject* /*widget*/, QEvent* event) override {
        if (event->type() == m_type) {
            m_call();
        }
        return false;
    }

private:
    QEvent::Type m_type;
    std::function<void()> m_call;
};

} // namespace posewire::gui
