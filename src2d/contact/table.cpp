#include "src2d/contact/table.h"

#include <algorithm>
#include <functional>

#include "src2d/core/memory.h"

namespace merge2d {
namespace {

ContactTable::Slot takeSlot(ContactTable& table) {
  if (table.free_slots.empty()) {
    table.slots.emplace_back();
    return static_cast<ContactTable::Slot>(table.slots.size() - 1);
  }
  const ContactTable::Slot slot = table.free_slots.back();
  table.free_slots.pop_back();
  return slot;
}

/// True for a quarter or more.
bool many(std::size_t some, std::size_t all) { return some > 0 && 4 * some >= all; }

/// How many contacts do not follow the one before them in memory: they are in slots that others
/// have left, and every walk over the table waits for memory. Where most are, a step of a tower of
/// 20,000 takes twice as long.
std::size_t countScattered(const ContactTable& table) {
  constexpr ContactTable::Slot kClose = 8;
  std::size_t count = 0;
  for (std::size_t i = 1; i < table.order.size(); ++i) {
    const ContactTable::Slot ahead = table.order[i] - table.order[i - 1];  // wraps where it is back
    count += ahead > kClose ? 1 : 0;
  }
  return count;
}

bool retires(const Contact& contact) { return contact.count == 0; }

/// The key of the contact in a slot.
auto keyIn(const ContactTable& table) {
  return [&table](ContactTable::Slot slot) -> const ContactKey& { return table[slot].key; };
}

/// The first of an ascending list whose key is not less, when all before `at` are less: quick where
/// it is near.
template <class It, class KeyOf>
It seek(It at, It end, const ContactKey& key, KeyOf&& keyOf) {
  std::ptrdiff_t stride = 1;
  for (; end - at > stride && std::invoke(keyOf, at[stride]) < key; stride *= 2) at += stride;
  return std::ranges::lower_bound(at, at + std::min(stride + 1, end - at), key, {}, keyOf);
}

/// The first of an ascending list whose key is not less: quick where it is near the end.
template <class It, class KeyOf>
It seekBack(It begin, It end, const ContactKey& key, KeyOf&& keyOf) {
  It at = end;
  std::ptrdiff_t stride = 1;
  for (; at - begin > stride && key < std::invoke(keyOf, at[-stride]); stride *= 2) at -= stride;
  return std::ranges::lower_bound(at - std::min(stride, at - begin), at, key, {}, keyOf);
}

/// Merges the elements behind `middle` into the ascending ones before it, by key. Few of them are
/// compared with few.
template <class T, class KeyOf>
void mergeTail(std::vector<T>& list, std::size_t middle, KeyOf&& keyOf) {
  const auto begin = list.begin();
  auto end = begin + static_cast<std::ptrdiff_t>(middle), to = list.end();
  const std::vector<T> tail(end, to);
  for (auto last = tail.rbegin(); last != tail.rend(); ++last) {
    const auto at = seekBack(begin, end, std::invoke(keyOf, *last), keyOf);
    to = std::move_backward(at, end, to);
    *--to = *last;
    end = at;
  }
}

}  // namespace

const ContactTable::Slot* findContact(const ContactTable& table, const ContactKey& key) {
  const auto at = std::ranges::lower_bound(table.order, key, {}, keyIn(table));
  return at != table.order.end() && table[*at].key == key ? &*at : nullptr;
}

void addContacts(ContactTable& table, const std::vector<Contact>& contacts) {
  if (contacts.empty()) return;
  const auto isIdle = [&](const Contact& contact) {
    return std::ranges::binary_search(table.idle, contact.key, {}, &IdlePair::key);
  };
  if (std::ranges::any_of(contacts, isIdle)) {
    std::erase_if(table.idle, [&](const IdlePair& pair) {
      return std::ranges::binary_search(contacts, pair.key, {}, &Contact::key);
    });
  }
  const std::size_t known = table.order.size();
  const std::size_t free = std::min(table.free_slots.size(), contacts.size());
  reserveTightly(table.order, known + contacts.size());
  reserveTightly(table.slots, table.slots.size() + contacts.size() - free);
  for (const Contact& contact : contacts) {
    const ContactTable::Slot slot = takeSlot(table);
    table[slot] = contact;
    table.order.push_back(slot);
  }
  mergeTail(table.order, known, keyIn(table));
}

void addIdlePairs(ContactTable& table, const std::vector<ContactKey>& keys) {
  const std::size_t known = table.idle.size();
  std::size_t idle = 0;
  auto contact = table.order.begin();
  for (const ContactKey& key : keys) {
    const auto first = table.idle.begin(), end = first + static_cast<std::ptrdiff_t>(known);
    const auto at = seek(first + static_cast<std::ptrdiff_t>(idle), end, key, &IdlePair::key);
    idle = static_cast<std::size_t>(at - first);
    if (at != end && at->key == key) continue;
    contact = seek(contact, table.order.end(), key, keyIn(table));
    if (contact != table.order.end() && table[*contact].key == key) continue;
    table.idle.push_back({key});
  }
  if (table.idle.size() > known) mergeTail(table.idle, known, &IdlePair::key);
}

void retireContacts(ContactTable& table, Upkeep when) {
  const auto count = std::ranges::count_if(
      table.order, [&](ContactTable::Slot slot) { return retires(table[slot]); });
  const bool is_many = many(static_cast<std::size_t>(count), table.order.size());
  if (count == 0 || (when == Upkeep::WhenMany && !is_many)) return;
  const std::size_t known = table.idle.size();
  reserveTightly(table.idle, known + static_cast<std::size_t>(count));
  dropContacts(table, [&](const Contact& contact) {
    if (!retires(contact)) return false;
    table.idle.push_back({contact.key});
    return true;
  });
  mergeTail(table.idle, known, &IdlePair::key);
}

void compactContacts(ContactTable& table, Upkeep when) {
  trim(table.idle);
  if (when == Upkeep::WhenMany && !many(table.free_slots.size(), table.slots.size()) &&
      !many(countScattered(table), table.order.size())) {
    return;
  }
  std::vector<Contact> slots;
  slots.reserve(table.slots.size() - table.free_slots.size());
  const auto keep = [&](ContactTable::Slot& slot) {
    slots.push_back(table.slots[slot]);
    slot = static_cast<ContactTable::Slot>(slots.size() - 1);
  };
  for (ContactTable::Slot& slot : table.order) keep(slot);
  table.parked.forEach(keep);
  table.slots = std::move(slots);
  table.free_slots.clear();
  trim(table.free_slots);
  trim(table.order);
}

}  // namespace merge2d
