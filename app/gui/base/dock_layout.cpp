// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/dock_layout.h"

#include "app/gui/base/saving.h"
#include "app/gui/theme/words.h"

#include <QDockWidget>
#include <QJsonArray>
#include <QJsonObject>

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

namespace posewire::gui {

namespace {

/// Raised when the meaning of something in the files changes.
constexpr int kLayoutSchema = 1;
constexpr int kLeastCharacters = 54;
constexpr int kLeastLines = 13; ///< a title, tabs, a bar, column titles and some rows
constexpr double kDefaultExtent = 0.22;
constexpr int kLongestName = 60;
/// Against other places: pixels times the sum of all shares must be an int.
constexpr int kGreatestShare = 100;

const std::array<std::pair<const char*, Qt::DockWidgetArea>, 3> kAreas{
    {{"left", Qt::LeftDockWidgetArea},
     {"right", Qt::RightDockWidgetArea},
     {"bottom", Qt::BottomDockWidgetArea}}};

/// {"docks": ["characters"], "share": 3}
DockLayout::Place placeOf(const QJsonObject& object) {
    DockLayout::Place place;
    place.share = std::clamp(object["share"].toInt(1), 1, kGreatestShare);
    for (const auto& dock : object["docks"].toArray()) {
        place.docks += dock.toString();
    }
    return place;
}

Qt::Orientation orientationOf(Qt::DockWidgetArea area) {
    return area == Qt::BottomDockWidgetArea ? Qt::Horizontal : Qt::Vertical;
}

/// The first dock of the place, with the others as tabs behind it; null if the program has none of them.
QDockWidget* putPlace(const DockLayout::Place& place, Qt::DockWidgetArea area, QMainWindow& window) {
    QDockWidget* first = nullptr;
    for (const QString& name : place.docks) {
        auto* dock = window.findChild<QDockWidget*>(name, Qt::FindDirectChildrenOnly);
        if (dock == nullptr) {
            continue;
        }
        window.addDockWidget(area, dock, orientationOf(area));
        dock->setVisible(true);
        if (first != nullptr) {
            window.tabifyDockWidget(first, dock);
        } else {
            first = dock;
        }
    }
    if (first != nullptr) {
        first->raise();
    }
    return first;
}

/// The width of a column of docks at a side, the height of the row at the bottom, in pixels.
int extentOf(Qt::DockWidgetArea area, double share, const QMainWindow& window) {
    // A share of a small window would cut its tables: docks have room for words and rows, up to a third of
    // its width and two fifths of its height.
    const QFontMetrics metrics = window.fontMetrics();
    const bool isBottom = area == Qt::BottomDockWidgetArea;
    const int across = isBottom ? window.height() : window.width();
    const int least = isBottom ? std::min(metrics.height() * kLeastLines, across * 2 / 5)
                               : std::min(metrics.averageCharWidth() * kLeastCharacters, across / 3);
    return std::max(static_cast<int>(across * share), least);
}

/// The docks that show in an area, each with its share.
using Shares = std::vector<std::pair<QDockWidget*, int>>;

/// The docks of an area share its length.
void shareOut(Qt::DockWidgetArea area, const Shares& docks, int length, QMainWindow& window) {
    const int total = std::accumulate(docks.begin(), docks.end(), 0,
                                      [](int sum, const auto& dock) { return sum + dock.second; });
    QList<QDockWidget*> widgets;
    QList<int> lengths;
    for (const auto& [dock, share] : docks) {
        widgets += dock;
        lengths += length * share / std::max(1, total);
    }
    window.resizeDocks(widgets, lengths, orientationOf(area));
}

void sizeAreas(const DockLayout& layout, const std::map<Qt::DockWidgetArea, Shares>& placed,
               QMainWindow& window) {
    // The columns at the sides at once: one after the other they would take the room from each other.
    QList<QDockWidget*> sides;
    QList<int> widths;
    for (const auto& [side, docks] : placed) {
        const int extent = extentOf(side, layout.areas.at(side).extent, window);
        if (side == Qt::BottomDockWidgetArea) {
            window.resizeDocks({docks.front().first}, {extent}, Qt::Vertical);
        } else {
            sides += docks.front().first;
            widths += extent;
        }
    }
    window.resizeDocks(sides, widths, Qt::Horizontal);
    const int between = std::accumulate(widths.begin(), widths.end(), window.width(), std::minus());
    for (const auto& [side, docks] : placed) {
        if (docks.size() > 1) {
            shareOut(side, docks, side == Qt::BottomDockWidgetArea ? between : window.height(), window);
        }
    }
}

/// Of those that show in an area one that has tabs, else the farthest to the right and below; null where
/// there is none.
QDockWidget* dockForTab(Qt::DockWidgetArea area, const QMainWindow& window) {
    QDockWidget* best = nullptr;
    for (QDockWidget* dock : window.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly)) {
        if (dock->isHidden() || dock->isFloating() || window.dockWidgetArea(dock) != area) {
            continue;
        }
        const auto rank = [&window](QDockWidget* each) {
            return std::pair(!window.tabifiedDockWidgets(each).isEmpty(), each->x() + each->y());
        };
        if (best == nullptr || rank(dock) > rank(best)) {
            best = dock;
        }
    }
    return best;
}

} // namespace

QStringList layoutNames() {
    return {QStringLiteral("Check"), QStringLiteral("Debug"), QStringLiteral("Inspect")};
}

tl::expected<DockLayout, QString> parseLayout(const QByteArray& json) {
    const auto document = parseSmallObject(json);
    if (!document) {
        return tl::unexpected(tr("not a layout: %1").arg(document.error()));
    }
    // The first ones had no version.
    if (const int schema = (*document)["schema"].toInt(1); schema < 1 || schema > kLayoutSchema) {
        return tl::unexpected(
            tr("its version is %1, this program reads version %2").arg(schema).arg(kLayoutSchema));
    }
    DockLayout layout;
    layout.name = (*document)["name"].toString().left(kLongestName);
    layout.hasLargeVerdict = (*document)["largeVerdict"].toBool();
    const QJsonObject areas = (*document)["areas"].toObject();
    for (const auto& [name, area] : kAreas) {
        const QJsonObject object = areas[QLatin1String(name)].toObject();
        DockLayout::Area read{std::clamp(object["extent"].toDouble(kDefaultExtent), 0.05, 0.8), {}};
        for (const auto& place : object["places"].toArray()) {
            read.places.push_back(placeOf(place.toObject()));
        }
        if (!read.places.empty()) {
            layout.areas[area] = read;
        }
    }
    if (layout.areas.empty()) {
        return tl::unexpected(tr("not a layout: it places no dock"));
    }
    return layout;
}

tl::expected<DockLayout, QString> findLayout(const QString& nameOrFile) {
    const bool isShipped = layoutNames().contains(nameOrFile, Qt::CaseInsensitive);
    const auto content =
        readSmallFile(isShipped ? QStringLiteral(":/layouts/%1.json").arg(nameOrFile.toLower()) : nameOrFile);
    if (!content) {
        return tl::unexpected(
            tr("Layout '%1' is none of %2, and no file that can be read: %3")
                .arg(nameOrFile, layoutNames().join(QStringLiteral(", ")), content.error()));
    }
    return parseLayout(*content).map_error(
        [&](const QString& text) { return nameOrFile + QStringLiteral(": ") + text; });
}

QStringList unknownDocks(const DockLayout& layout, const QStringList& docks) {
    QStringList unknown;
    for (const auto& [side, area] : layout.areas) {
        for (const DockLayout::Place& place : area.places) {
            std::ranges::copy_if(place.docks, std::back_inserter(unknown),
                                 [&](const QString& dock) { return !docks.contains(dock); });
        }
    }
    return unknown;
}

QStringList applyLayout(const DockLayout& layout, QMainWindow& window) {
    QStringList names;
    for (QDockWidget* dock : window.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly)) {
        names += dock->objectName();
        dock->setFloating(false);
        window.removeDockWidget(dock);
    }
    std::map<Qt::DockWidgetArea, Shares> placed;
    for (const auto& [side, area] : layout.areas) {
        for (const DockLayout::Place& place : area.places) {
            if (QDockWidget* dock = putPlace(place, side, window); dock != nullptr) {
                placed[side].emplace_back(dock, place.share);
            }
        }
    }
    sizeAreas(layout, placed, window);
    return unknownDocks(layout, names);
}

void placeDock(QDockWidget& dock, Qt::DockWidgetArea area, QMainWindow& window) {
    if (window.dockWidgetArea(&dock) != Qt::NoDockWidgetArea || dock.isFloating()) {
        return;
    }
    QDockWidget* beside = dockForTab(area, window);
    beside = beside == nullptr ? dockForTab(Qt::BottomDockWidgetArea, window) : beside;
    if (beside != nullptr) {
        window.tabifyDockWidget(beside, &dock);
    } else {
        window.addDockWidget(area, &dock, orientationOf(area));
    }
}

} // namespace posewire::gui
