// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/panels/filter_line.h"
#include "app/gui/theme/widgets.h"

#include <QElapsedTimer>
#include <QJsonObject>
#include <QProgressBar>
#include <QPushButton>
#include <QWidget>

#include <optional>
#include <vector>

class QMenu;

namespace posewire::gui {

/// The line of the display filter, buttons for filters that were saved, and what else is to be said about the
/// filter: what is wrong with it, that a jump put it there, how far it has come.
class FilterBar final : public QWidget {
    Q_OBJECT

public:
    explicit FilterBar(QWidget* parent = nullptr);

    [[nodiscard]] FilterLine& line() const { return *m_line; }
    void focusLine();

    /// Says that a jump put the filter there, and what was filtered by before; nothing if none did.
    void setJump(const std::optional<QString>& before);

    /// How far a filter has come through what was there when it was set, as a share; nothing while none is on
    /// its way. Only one that takes a while shows it: the list would jump to and fro for others.
    void setProgress(std::optional<double> share);

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

    /// History and saved filters, to be kept from one run to the next.
    [[nodiscard]] QJsonObject state() const;
    void restoreState(const QJsonObject& state);

signals:
    void cancelRequested();
    /// The filter from before the jump is wanted.
    void backRequested();

private:
    void layOut();
    void applySaved(std::size_t index);
    void askAbout(std::size_t index, const QPoint& place);
    [[nodiscard]] QString askForName(const QString& title, const QString& accept, QString before);

    QLabel* m_problem = plainLabel(this);
    FilterLine* m_line;
    CommandBar* m_buttons = new CommandBar(this);
    QWidget* m_progressRow = new QWidget(this);
    QProgressBar* m_progress = new QProgressBar(this);
    QElapsedTimer m_busySince; ///< valid while a filter is on its way
    QWidget* m_jumpRow = new QWidget(this);
    QPushButton* m_back = new QPushButton(m_jumpRow);
    std::vector<Saved> m_saved;
};

[[nodiscard]] std::vector<FilterBar::Saved> defaultFilters();

} // namespace posewire::gui
