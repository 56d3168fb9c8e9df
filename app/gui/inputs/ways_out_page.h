// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/driver/ways_out.h"
#include "app/gui/inputs/undo_removal.h"
#include "app/gui/models/receiving_models.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/widgets.h"

#include <QLineEdit>
#include <QPushButton>
#include <QWidget>

namespace posewire::gui {

/// Lists the ways out with their form and what they got; adds, switches and removes them.
class WaysOutPage final : public QWidget {
    Q_OBJECT

public:
    explicit WaysOutPage(WaysOut& waysOut, QWidget* parent = nullptr);

    void refresh();

    void submit();
    void removeSelected(); ///< until it is undone

    [[nodiscard]] const QString& problem() const { return m_problem; }
    [[nodiscard]] WaysOutModel& model() { return m_model; }

signals:
    void choicesChanged();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void layOut();
    void remove(const WayOut& choice);
    void putBack(const WayOut& choice, std::size_t row);
    void switchTarget(int row, bool isOn);
    void showKind();
    [[nodiscard]] tl::expected<WayOut, QString> read() const;
    void setProblem(const QString& problem);
    void showNote();

    WaysOut& m_waysOut;
    WaysOutModel m_model;
    TableView* m_table = new TableView(tr("Ways out"), this);
    ComboBox* m_kind = new ComboBox(this);
    QLineEdit* m_target = new QLineEdit(this);
    QLineEdit* m_character = new QLineEdit(this); ///< only of forms that are of one
    Note* m_note = new Note(this);
    QPushButton* m_add = new QPushButton(tr("&Add target"), this);
    QPushButton* m_remove = new QPushButton(tr("&Remove"), this);
    UndoRemoval* m_undo = new UndoRemoval(this);
    QString m_problem;
};

/// "HOST:PORT", "HOST" for the port that MVN uses, "[IPv6]:PORT"; the error is a sentence.
[[nodiscard]] tl::expected<WayOut, QString> readTarget(const QString& text);

} // namespace posewire::gui
