// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "core/model/session/session_view.h"

#include <QDialog>
#include <QMap>
#include <QString>

class QLabel;
class QLineEdit;
class QListWidget;
class QTextBrowser;

/// Texts to read, and windows to read them in.
namespace posewire::gui {

class MarkdownView;

/// A long text in Markdown to look things up in: contents at the left, search above, links that lead to
/// headings.
class ReferenceWindow final : public QDialog {
    Q_OBJECT

public:
    ReferenceWindow(const QString& title, const QString& markdown, QWidget* parent);

    [[nodiscard]] QTextBrowser& browser() const;
    [[nodiscard]] QListWidget& contents() const { return *m_contents; }
    [[nodiscard]] QLineEdit& searchEdit() const { return *m_search; }

    /// Shows a heading by its anchor, as in the links of the text; false where there is none.
    bool goTo(const QString& anchor);
    /// Selects the next place, or the previous one, that contains the search text; begins again at the
    /// other end.
    bool find(bool isBackward);

private:
    void layOut();
    void listHeadings();
    void search(const QString& text);

    MarkdownView* m_browser;
    QListWidget* m_contents;
    QLineEdit* m_search;
    QLabel* m_found;
};

/// What the program itself writes into the user guide, in Markdown: the keys of the menus, the overlays, the
/// figures of streams.
[[nodiscard]] QMap<QString, QString> madeHelpParts();
void showAbout(QWidget& parent);

/// What someone who helps from afar wants to know, as plain text: program, system, ports, senders, streams.
[[nodiscard]] QString diagnosticsText(model::SessionView& session, const ReceivingState& receiving,
                                      const QString& rendererName);

} // namespace posewire::gui
