#pragma once
/// Typed ids into flat tables. Everything that needs an order is ordered by id.

#include <cstddef>
#include <cstdint>

namespace merge2d {

/// A body, numbered in the order of the scene from 0.
enum class BodyId : std::uint32_t {};

/// A collection; ids are never used twice in a run. A free body has `kNoCollection`.
enum class CollectionId : std::int32_t {};
inline constexpr CollectionId kNoCollection{-1};

/// Instead of an index: none.
inline constexpr std::uint32_t kNone = ~std::uint32_t{0};

constexpr std::size_t index(BodyId id) { return static_cast<std::size_t>(id); }
constexpr std::int32_t value(CollectionId id) { return static_cast<std::int32_t>(id); }

}  // namespace merge2d
