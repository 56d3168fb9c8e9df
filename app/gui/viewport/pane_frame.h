// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QRect>
#include <QString>
#include <QWidget>

#include <vector>

namespace posewire::gui {

/// The lines between the panes of a view, their names, and the frame around the active one.
class PaneFrame final : public QWidget {
    Q_OBJECT

public:
    explicit PaneFrame(QWidget* parent);

    struct NamedPane {
        QRect place;
        QString name;

        bool operator==(const NamedPane&) const = default;
    };
    /// None for a view that is not split.
    void setPanes(const std::vector<NamedPane>& panes, int active);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::vector<NamedPane> m_panes;
    int m_active = 0;
};

} // namespace posewire::gui
