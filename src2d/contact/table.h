#pragma once
/// Upkeep of the contact table: what comes in, what leaves, what goes idle. Both its lists stay
/// ascending by key, and no key is in both.

#include "src2d/dynamics/contact_table.h"

namespace merge2d {

/// Adds contacts (ascending by key, unique, none of them in `order`); those that were idle are so
/// no longer.
void addContacts(ContactTable& table, const std::vector<Contact>& contacts);

/// Adds pairs (ascending, unique) that are near each other; those already there are left alone.
void addIdlePairs(ContactTable& table, const std::vector<ContactKey>& keys);

/// When to do something that changes no step.
enum class Upkeep : std::uint8_t { WhenMany, Now };

/// Makes contacts without points idle. Those that have more to remember stay.
void retireContacts(ContactTable& table, Upkeep when = Upkeep::WhenMany);

/// Gives back the memory of dropped contacts, and puts the others in the order of their keys; slots
/// move.
void compactContacts(ContactTable& table, Upkeep when = Upkeep::WhenMany);

/// The slot of a contact in `order`, or nullptr.
const ContactTable::Slot* findContact(const ContactTable& table, const ContactKey& key);

/// Drops all contacts for which `gone(contact)` holds.
template <class Gone>
void dropContacts(ContactTable& table, Gone&& gone) {
  std::size_t kept = 0;
  for (const ContactTable::Slot slot : table.order) {
    if (gone(table[slot])) {
      table.free_slots.push_back(slot);
    } else {
      table.order[kept++] = slot;
    }
  }
  table.order.resize(kept);
}

/// In a first step or after a crash they are many; their memory is not needed again.
template <class T>
void releaseMany(std::vector<T>& list) {
  constexpr std::size_t kMany = 4096;  // bytes
  if (list.size() * sizeof(T) > kMany) std::vector<T>().swap(list);
}

}  // namespace merge2d
