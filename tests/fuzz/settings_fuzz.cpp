// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/dock_layout.h"
#include "app/gui/base/settings.h"

#include <QApplication>
#include <QDockWidget>
#include <QJsonDocument>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

// Whatever bytes a file of settings or a layout has: what is read of it is of a size and a kind that the
// window can use, it is the same when it was written and read again, and a window takes the places of docks
// from it.
namespace {

using namespace posewire::gui;

void require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

/// A window with docks of the names that ours has, without a display.
class Stage {
public:
    Stage() : m_application(m_argumentCount, m_arguments) {
        for (const char* name : {"characters", "metadata", "statistics", "timecode", "trackers", "packets",
                                 "inspector", "nullpose", "joints", "plots", "events", "timeline"}) {
            auto* dock = new QDockWidget(&m_window);
            dock->setObjectName(QLatin1String(name));
            dock->setWidget(new QWidget(dock));
            m_window.addDockWidget(Qt::LeftDockWidgetArea, dock);
        }
        m_window.show();
    }
    QMainWindow& window() { return m_window; }

private:
    int m_argumentCount = 3;
    char m_name[9] = "settings";
    char m_option[10] = "-platform";
    char m_platform[10] = "offscreen";
    char* m_arguments[4] = {m_name, m_option, m_platform, nullptr};
    QApplication m_application;
    QMainWindow m_window;
};

QMainWindow& window() {
    static Stage* const stage = new Stage; // Qt does not outlive main()
    return stage->window();
}

void checkSettings(const QByteArray& bytes) {
    const auto settings = parseSettings(bytes);
    if (!settings) {
        require(!settings.error().isEmpty());
        return;
    }
    const auto again = parseSettings(QJsonDocument(jsonOf(*settings)).toJson());
    require(again && *again == *settings);
    require(settings->window.width() >= 0 && settings->window.right() >= settings->window.left() - 1);
    require(settings->inputs.waysOut.size() <= 256);
    for (const InputAddress& input : settings->inputs.inputs.value_or(std::vector<InputAddress>())) {
        require(input.port != 0);
    }
    if (!settings->docks.isEmpty()) {
        window().restoreState(settings->docks, 1); // what is damaged has no docks
        QCoreApplication::processEvents();
    }
}

void checkLayout(const QByteArray& bytes) {
    const auto layout = parseLayout(bytes);
    if (!layout) {
        require(!layout.error().isEmpty());
        return;
    }
    require(!layout->areas.empty());
    static_cast<void>(applyLayout(*layout, window()));
    QCoreApplication::processEvents();
}

} // namespace

// What fonts take is theirs.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libfontconfig";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const QByteArray bytes(reinterpret_cast<const char*>(data), static_cast<qsizetype>(size));
    checkSettings(bytes);
    checkLayout(bytes);
    return 0;
}
