// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QMap>
#include <QObject>

#include <memory>

class QUrl;

namespace posewire::gui {

class HelpPages;
class MainWindow;

/// The user guide as the window opens it: at a place, for the part of the window that has the keyboard, and
/// by the links of openHelp().
class Guide final : public QObject {
    Q_OBJECT

public:
    explicit Guide(MainWindow& window);
    ~Guide() override;

    /// Shows a place of the guide, its first page for none; over a dialog that waits for an answer if there
    /// is one.
    void show(const QString& place);
    /// At the first start: says where the guide leads through the window.
    void offerFirstSteps();

public slots:
    void follow(const QUrl& link);

private:
    MainWindow& m_window;
    std::unique_ptr<HelpPages> m_pages; ///< once the guide was asked for
};

/// The parts of the user guide that come from tables of the program, in Markdown, by their names: the keys of
/// the menus, the figures of streams, the protocol.
[[nodiscard]] QMap<QString, QString> madeHelpParts();

} // namespace posewire::gui
