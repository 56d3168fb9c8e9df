// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/filter/completion.h"
#include "core/filter/filter.h"

#include <QCompleter>
#include <QLineEdit>
#include <QStandardItemModel>

#include <functional>
#include <optional>

class QLabel;

namespace posewire::gui {

/// The language that is written in a line.
struct LineLanguage {
    std::function<std::optional<filter::FilterError>(const std::string& text)> errorOf;
    std::function<std::vector<filter::Completion>(const std::string& text, std::size_t cursor)> completions;
    QString onEnter;   ///< what Enter does, in words
    QString onHistory; ///< what Alt and arrow down does
};
[[nodiscard]] LineLanguage filterLanguage();

/// The line of the display filter, or of another language: shows while it is written whether it is right, and
/// where it is not; offers what may follow, and what was used before (Alt and arrow down).
class FilterLine final : public QLineEdit {
    Q_OBJECT

public:
    /// Says in `problem` what is wrong once the line is left or applied: what is still being written is not
    /// wrong yet.
    FilterLine(QLabel* problem, QWidget* parent, LineLanguage language = filterLanguage());

    [[nodiscard]] QString filter() const { return text().trimmed(); }
    /// Shows a filter that is in use, also one set elsewhere.
    void setApplied(const QString& filter);
    /// Applies what is written, if it is right.
    void apply();
    bool check();
    [[nodiscard]] const std::optional<filter::FilterError>& error() const { return m_error; }

    /// Filters used before, the newest first.
    [[nodiscard]] const QStringList& history() const { return m_history; }
    void setHistory(const QStringList& history);

signals:
    /// Only ever with a text that is right.
    void applied(const QString& text);
    /// The keyboard is wanted in the list.
    void left();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void compile();
    void showError();
    void underline();
    void restyle();
    void applyAndLeave();
    void offerCompletions();
    void offerHistory();
    void addOffer(const QString& text, const QString& about, std::size_t offset, std::size_t length);
    void offer();
    void insertOffer(const QModelIndex& offer);

    LineLanguage m_language;
    QLabel* m_problem;
    QStandardItemModel* m_offers = new QStandardItemModel(this);
    QCompleter* m_completer = new QCompleter(m_offers, this);
    bool m_hasChosen = false; ///< one of the offers, by the arrows
    QStringList m_history;
    QString m_applied;
    std::optional<filter::FilterError> m_error;
};

} // namespace posewire::gui
