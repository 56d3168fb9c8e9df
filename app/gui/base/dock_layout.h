// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QMainWindow>
#include <QString>
#include <QStringList>

#include <tl/expected.hpp>

#include <map>
#include <vector>

namespace posewire::gui {

/// Docks that are not named are closed.
struct DockLayout {
    /// One place in an area, from top to bottom (at the bottom: from left to right); several docks are tabs.
    struct Place {
        QStringList docks;
        int share = 1; ///< of the area's length, against the other places
    };
    struct Area {
        double extent = 0; ///< width, height at the bottom, as a share of the window
        std::vector<Place> places;
    };
    QString name;
    bool hasLargeVerdict = false;
    std::map<Qt::DockWidgetArea, Area> areas; ///< those with places
};

[[nodiscard]] QStringList layoutNames();

/// From JSON as in resources/layouts; the error says what is wrong with it.
[[nodiscard]] tl::expected<DockLayout, QString> parseLayout(const QByteArray& json);

/// A layout that ships, whatever the case of its name, or a file.
[[nodiscard]] tl::expected<DockLayout, QString> findLayout(const QString& nameOrFile);

/// The docks of a layout that are not among `docks`, in the order of the layout.
[[nodiscard]] QStringList unknownDocks(const DockLayout& layout, const QStringList& docks);

/// Puts the window's docks, known by their object names, where the layout says. The answer is the names in
/// the layout that no dock of the window has; they are skipped.
QStringList applyLayout(const DockLayout& layout, QMainWindow& window);

/// Finds a place for a dock that has none, for the layout names it nowhere: as a tab beside others of `area`,
/// or of the bottom. A place of its own would leave too little for the others.
void placeDock(QDockWidget& dock, Qt::DockWidgetArea area, QMainWindow& window);

} // namespace posewire::gui
