// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTextBrowser>

namespace posewire::gui {

class HelpPages;

/// Shows the pages of the guide in the colours of the theme: tables with thin lines, pictures no wider than
/// the view. Its source is a place, "packets" or "packets#filter"; history and steps back are QTextBrowser's.
/// The owner follows the links.
class MarkdownView final : public QTextBrowser {
    Q_OBJECT

public:
    /// The pages must outlive the view.
    MarkdownView(const HelpPages& pages, QWidget* parent);

    /// Selects the next place, or the previous one, that contains the words as they are; begins again at the
    /// other end. False if the page does not contain them.
    bool findAgain(const QString& words, bool isBackward);
    /// Paints all places where one of these words begins; none for no words.
    void highlight(const QStringList& words);

    [[nodiscard]] QVariant loadResource(int type, const QUrl& name) override;

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void arrive(const QUrl& place);
    void applyColours();
    void fitPictures();
    void showPosition(int position);

    const HelpPages& m_pages;
    QString m_page; ///< that is loaded
    QStringList m_highlighted;
    int m_fittedWidth = 0; ///< of the pictures
};

} // namespace posewire::gui
