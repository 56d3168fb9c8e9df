// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/filter/filter.h"

#include <QElapsedTimer>
#include <QJsonObject>
#include <QStringList>
#include <QWidget>

#include <optional>
#include <vector>

class QCompleter;
class QLabel;
class QLineEdit;
class QMenu;
class QProgressBar;
class QPushButton;
class QStandardItemModel;

namespace posewire::gui {

class CommandBar;

/// The line of the display filter: shows while it is written whether it is right, and where it is not; offers
/// what may follow, what was used before (Alt and arrow down) and what was saved (the buttons).
class FilterBar final : public QWidget {
    Q_OBJECT

public:
    explicit FilterBar(QWidget* parent = nullptr);

    [[nodiscard]] QString text() const;
    /// Shows a filter that is in use, also one set elsewhere.
    void setApplied(const QString& text);
    /// Puts the keyboard into the line.
    void focusLine();

    /// Says that a jump put the filter there, and what was filtered by before; nothing where none did.
    void setJump(const std::optional<QString>& before);

    /// How far a filter has come through what was there when it was set, as a share; nothing while none is on
    /// its way. Only one that takes a while shows it: the list would jump to and fro for others.
    void setProgress(std::optional<double> share);
    [[nodiscard]] bool isBusy() const { return m_busySince.isValid(); }

    /// What is wrong with the text in the line; nothing where it is right.
    [[nodiscard]] const std::optional<filter::FilterError>& error() const { return m_error; }
    [[nodiscard]] QString errorText() const;

    struct Saved {
        QString name;
        QString text;
        friend bool operator==(const Saved&, const Saved&) = default;
    };
    [[nodiscard]] const std::vector<Saved>& saved() const { return m_saved; }
    void setSaved(std::vector<Saved> saved);
    /// With what applies them.
    void listSaved(QMenu& menu);
    /// As a button, under a name that is asked for.
    void saveCurrent();
    [[nodiscard]] const QStringList& history() const { return m_history; }

    /// History and saved filters, to be kept from one run to the next.
    [[nodiscard]] QJsonObject state() const;
    void restoreState(const QJsonObject& state);

signals:
    /// Only ever with a text that is right.
    void applied(const QString& text);
    void cancelRequested();
    /// The filter from before the jump is wanted.
    void backRequested();
    /// The keyboard is wanted in the list.
    void left();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void layOut();
    void layOutJump();
    void makeCompleter();
    void check();
    void showError();
    void underline();
    void restyle();
    void apply();
    void applyAndLeave();
    void remember(const QString& text);
    void offerCompletions();
    void offerHistory();
    void offer();
    void insertOffer(const QModelIndex& offer);
    void takeOffer();
    void hideOffers();
    bool offersTake(int key);
    void showSaved();
    void applySaved(std::size_t index);
    void askAbout(std::size_t index, const QPoint& place);
    void rename(std::size_t index);
    [[nodiscard]] QString askForName(const QString& title, const QString& accept, QString before);

    QLineEdit* m_line;
    CommandBar* m_buttons;
    QWidget* m_progressRow;
    QProgressBar* m_progress;
    QElapsedTimer m_busySince; ///< valid while a filter is on its way
    QLabel* m_problem;
    QWidget* m_jumpRow;
    QPushButton* m_back;
    QCompleter* m_completer = nullptr;
    bool m_hasChosen = false; ///< one of the offers, by the arrows
    QStandardItemModel* m_offers = nullptr;
    std::vector<Saved> m_saved;
    QStringList m_history; ///< newest first
    QString m_appliedText;
    std::optional<filter::FilterError> m_error;
};

/// What ships.
[[nodiscard]] std::vector<FilterBar::Saved> defaultFilters();

} // namespace posewire::gui
