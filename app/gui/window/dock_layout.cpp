// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/dock_layout.h"

#include <QCoreApplication>
#include <QDockWidget>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

namespace posewire::gui {

namespace {

constexpr int kLeastCharacters = 54;
constexpr double kDefaultExtent = 0.22;

const std::array<std::pair<const char*, Qt::DockWidgetArea>, 3> kAreas{
    {{"left", Qt::LeftDockWidgetArea},
     {"right", Qt::RightDockWidgetArea},
     {"bottom", Qt::BottomDockWidgetArea}}};

QString tr(const char* text) {
    return QCoreApplication::translate("DockLayout", text);
}

/// {"docks": ["characters"], "share": 3}
DockLayout::Place placeOf(const QJsonObject& object, Qt::DockWidgetArea area) {
    DockLayout::Place place;
    place.area = area;
    place.share = std::max(1, object["share"].toInt(1));
    for (const auto& dock : object["docks"].toArray()) {
        place.docks += dock.toString();
    }
    return place;
}

Qt::Orientation orientationOf(Qt::DockWidgetArea area) {
    return area == Qt::BottomDockWidgetArea ? Qt::Horizontal : Qt::Vertical;
}

/// The first dock of the place, with the others as tabs behind it; null where the program has none of them.
QDockWidget* putPlace(const DockLayout::Place& place, QMainWindow& window) {
    QDockWidget* first = nullptr;
    for (const QString& name : place.docks) {
        auto* dock = window.findChild<QDockWidget*>(name, Qt::FindDirectChildrenOnly);
        if (dock == nullptr) {
            continue;
        }
        window.addDockWidget(place.area, dock, orientationOf(place.area));
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

void sizeArea(const DockLayout& layout, Qt::DockWidgetArea area, QMainWindow& window,
              const std::vector<std::pair<QDockWidget*, int>>& docks) {
    const auto extent = layout.extents.find(area);
    const double share = extent == layout.extents.end() ? kDefaultExtent : extent->second;
    const bool isBottom = area == Qt::BottomDockWidgetArea;
    const int across = isBottom ? window.height() : window.width();
    const int along = isBottom ? window.width() : window.height();
    const int total = std::accumulate(docks.begin(), docks.end(), 0,
                                      [](int sum, const auto& dock) { return sum + dock.second; });
    QList<QDockWidget*> widgets;
    QList<int> lengths;
    for (const auto& [dock, weight] : docks) {
        widgets += dock;
        lengths += along * weight / std::max(1, total);
    }
    if (widgets.isEmpty()) {
        return;
    }
    // A share of a small window would cut its tables: a column of docks has room for words, up to a third.
    const int words = isBottom ? 0 : window.fontMetrics().averageCharWidth() * kLeastCharacters;
    const int extentNow = std::max(static_cast<int>(across * share), std::min(words, across / 3));
    window.resizeDocks({widgets.front()}, {extentNow}, isBottom ? Qt::Vertical : Qt::Horizontal);
    window.resizeDocks(widgets, lengths, orientationOf(area));
}

} // namespace

QStringList layoutNames() {
    return {QStringLiteral("Check"), QStringLiteral("Debug"), QStringLiteral("Inspect")};
}

tl::expected<DockLayout, QString> parseLayout(const QByteArray& json) {
    QJsonParseError error;
    const QJsonDocument document = QJsonDocument::fromJson(json, &error);
    if (!document.isObject()) {
        return tl::unexpected(tr("not a layout: %1 at byte %2").arg(error.errorString()).arg(error.offset));
    }
    DockLayout layout;
    layout.name = document.object()["name"].toString();
    const QJsonObject areas = document.object()["areas"].toObject();
    for (const auto& [name, area] : kAreas) {
        const QJsonObject object = areas[QLatin1String(name)].toObject();
        if (object.contains("extent")) {
            layout.extents[area] = std::clamp(object["extent"].toDouble(kDefaultExtent), 0.05, 0.8);
        }
        for (const auto& place : object["places"].toArray()) {
            layout.places.push_back(placeOf(place.toObject(), area));
        }
    }
    if (layout.places.empty()) {
        return tl::unexpected(tr("not a layout: it places no dock"));
    }
    return layout;
}

tl::expected<DockLayout, QString> findLayout(const QString& nameOrFile) {
    const bool isShipped = layoutNames().contains(nameOrFile, Qt::CaseInsensitive);
    QFile file(isShipped ? QStringLiteral(":/layouts/%1.json").arg(nameOrFile.toLower()) : nameOrFile);
    if (!file.open(QIODevice::ReadOnly)) {
        return tl::unexpected(
            tr("Layout '%1' is none of %2, and no file that can be read: %3")
                .arg(nameOrFile, layoutNames().join(QStringLiteral(", ")), file.errorString()));
    }
    return parseLayout(file.readAll()).map_error([&](const QString& text) {
        return nameOrFile + QStringLiteral(": ") + text;
    });
}

QStringList unknownDocks(const DockLayout& layout, const QStringList& docks) {
    QStringList unknown;
    for (const DockLayout::Place& place : layout.places) {
        std::ranges::copy_if(place.docks, std::back_inserter(unknown),
                             [&](const QString& dock) { return !docks.contains(dock); });
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
    for (const auto& [name, area] : kAreas) {
        std::vector<std::pair<QDockWidget*, int>> docks;
        for (const DockLayout::Place& place : layout.places) {
            if (place.area != area) {
                continue;
            }
            if (QDockWidget* dock = putPlace(place, window); dock != nullptr) {
                docks.emplace_back(dock, place.share);
            }
        }
        sizeArea(layout, area, window, docks);
    }
    return unknownDocks(layout, names);
}

} // namespace posewire::gui
