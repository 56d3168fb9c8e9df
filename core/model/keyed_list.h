// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace posewire::model {

/// Things in the order in which they first appeared, found by their keys. Each stays where it is in memory
/// until it is removed; Item(key) makes one.
template <class Key, class Item>
class KeyedList {
public:
    /// Goes through the things themselves.
    class Iterator {
    public:
        using iterator_category = std::bidirectional_iterator_tag;
        using value_type = Item;
        using difference_type = std::ptrdiff_t;
        using pointer = const Item*;
        using reference = const Item&;

        Iterator() = default;
        explicit Iterator(const std::unique_ptr<Item>* at) : m_at(at) {}
        reference operator*() const { return **m_at; }
        pointer operator->() const { return m_at->get(); }
        Iterator& operator++() {
            ++m_at;
            return *this;
        }
        Iterator operator++(int) { return Iterator(m_at++); }
        Iterator& operator--() {
            --m_at;
            return *this;
        }
        Iterator operator--(int) { return Iterator(m_at--); }
        friend bool operator==(const Iterator&, const Iterator&) = default;
        friend difference_type operator-(const Iterator& a, const Iterator& b) { return a.m_at - b.m_at; }

    private:
        const std::unique_ptr<Item>* m_at = nullptr;
    };

    [[nodiscard]] std::size_t size() const { return m_items.size(); }
    [[nodiscard]] bool empty() const { return m_items.empty(); }
    [[nodiscard]] const Item& operator[](std::size_t place) const { return *m_items[place]; }
    [[nodiscard]] const Item& front() const { return *m_items.front(); }
    [[nodiscard]] const Item& back() const { return *m_items.back(); }
    [[nodiscard]] Iterator begin() const { return Iterator(m_items.data()); }
    [[nodiscard]] Iterator end() const { return Iterator(m_items.data() + m_items.size()); }

    /// Null where there is none.
    [[nodiscard]] Item* find(const Key& key) {
        const auto found = m_byKey.find(key);
        return found == m_byKey.end() ? nullptr : found->second;
    }
    [[nodiscard]] const Item* find(const Key& key) const {
        const auto found = m_byKey.find(key);
        return found == m_byKey.end() ? nullptr : found->second;
    }

    /// All of them, to be changed.
    template <class Change>
    void forEach(Change change) {
        for (const std::unique_ptr<Item>& item : m_items) {
            change(*item);
        }
    }

    /// At the end; there must be none of that key.
    Item& add(const Key& key) {
        Item& added = *m_items.emplace_back(std::make_unique<Item>(key));
        m_byKey.emplace(key, &added);
        return added;
    }

    /// Removes those for which `isGoing(item)`; the others keep their order.
    template <class Predicate>
    void eraseIf(Predicate isGoing) {
        std::erase_if(m_byKey, [&](const auto& entry) { return isGoing(std::as_const(*entry.second)); });
        std::erase_if(m_items, [&](const auto& item) { return isGoing(std::as_const(*item)); });
    }

private:
    std::vector<std::unique_ptr<Item>> m_items;
    std::unordered_map<Key, Item*> m_byKey;
};

} // namespace posewire::model
