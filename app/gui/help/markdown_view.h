// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTextBrowser>

#include <vector>

namespace posewire::gui {

/// A text of ours in Markdown, to be read in the colours of the theme: tables with thin lines, pictures no
/// wider than there is room, headings that links lead to. Who shows it follows the links.
class MarkdownView final : public QTextBrowser {
    Q_OBJECT

public:
    struct Heading {
        QString text;
        QString anchor; ///< as in the links of the text
        int level;
        int position; ///< in the document
    };

    /// `pictures`: the folder that the names of pictures are of.
    explicit MarkdownView(QWidget* parent, QString pictures = {});

    void showText(const QString& markdown);
    [[nodiscard]] const std::vector<Heading>& headings() const { return m_headings; }

    /// Shows a heading by its anchor; false where there is none.
    bool goTo(const QString& anchor);
    void showPlace(int position);

    /// Selects the next place, or the previous one, that contains the words as they are; begins again at the
    /// other end. False where there is none.
    bool findAgain(const QString& words, bool isBackward);
    [[nodiscard]] qsizetype countOf(const QString& words) const;
    /// Paints all places where one of these words begins; none for no words.
    void highlight(const QStringList& words);

    [[nodiscard]] QVariant loadResource(int type, const QUrl& name) override;

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void readHeadings();
    void applyColours();
    void fitPictures();

    QString m_pictures;
    std::vector<Heading> m_headings;
    QStringList m_highlighted;
    int m_fittedWidth = 0; ///< of the pictures
};

} // namespace posewire::gui
