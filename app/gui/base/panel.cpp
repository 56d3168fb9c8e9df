// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/panel.h"

#include <QAction>
#include <QCoreApplication>
#include <QMenu>

#include <string_view>

namespace posewire::gui {

void addEntries(QMenu& menu, std::span<const ActionInfo> table, const char* from, QWidget& owner) {
    for (const ActionInfo& info : table) {
        if (std::string_view(info.menu) != from) {
            continue;
        }
        if (info.list != nullptr) {
            info.list(owner, menu);
            continue;
        }
        if (info.run == nullptr) {
            menu.addSeparator();
            continue;
        }
        QAction* action = menu.addAction(QCoreApplication::translate("Action", info.text), &owner,
                                         [run = info.run, &owner] { run(owner); });
        action->setCheckable(info.isOn != nullptr);
        action->setChecked(info.isOn != nullptr && info.isOn(owner));
    }
}

} // namespace posewire::gui
