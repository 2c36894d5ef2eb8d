// Array<T>: a growable sequence on the context's allocator whose growth can fail with a status, and
// Span<T>: a view of consecutive elements that owns nothing.
//
// Invariants: T is trivially copyable and needs no destructor; an Array never throws, and a failed
// call leaves it as it was. New elements of resize() are uninitialised; assign() fills.
// Cost: push() is amortised constant. Routines reserve in their first lines where the size is
// known.
#pragma once

#include <type_traits>

#include "base/context.h"

namespace wireskin {

template <typename T>
class Span {
 public:
  Span() = default;
  Span(T* data, size_t size) : data_(data), size_(size) {}
  // A view of mutable elements is also a view of constant ones.
  template <typename U, typename = std::enable_if_t<std::is_same_v<const U, T>>>
  Span(const Span<U>& other) : data_(other.data()), size_(other.size()) {}

  T* data() const { return data_; }
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* begin() const { return data_; }
  T* end() const { return data_ + size_; }
  T& operator[](size_t i) const {
    WIRESKIN_ASSERT(i < size_);
    return data_[i];
  }
  Span part(size_t first, size_t count) const {
    WIRESKIN_ASSERT(first <= size_ && count <= size_ - first);
    return {data_ + first, count};
  }

 private:
  T* data_ = nullptr;
  size_t size_ = 0;
};

template <typename T>
class Array {
  static_assert(std::is_trivially_copyable_v<T>, "elements are moved by memcpy");

 public:
  explicit Array(Context& context) : context_(&context) {}
  Array(Array&& other) noexcept
      : context_(other.context_), data_(other.data_), size_(other.size_), room_(other.room_) {
    other.forget();
  }
  Array& operator=(Array&& other) noexcept {
    if (this != &other) {
      free();
      context_ = other.context_;
      data_ = other.data_;
      size_ = other.size_;
      room_ = other.room_;
      other.forget();
    }
    return *this;
  }
  ~Array() { free(); }

  Status reserve(size_t room) {
    if (room <= room_) return {};
    void* memory = nullptr;
    TRY(context_->allocate(room, sizeof(T), &memory));
    if (size_ != 0) std::memcpy(memory, data_, size_ * sizeof(T));
    context_->release(data_, room_, sizeof(T));
    data_ = static_cast<T*>(memory);
    room_ = room;
    return {};
  }

  Status resize(size_t size) {
    TRY(reserve(size));
    size_ = size;
    return {};
  }

  // Where what was there is not needed: it is given back before there is more, instead of copied.
  Status resize_anew(size_t size) {
    if (size > room_) free();
    return resize(size);
  }

  Status assign(size_t size, const T& value) {
    const T kept = value;  // as in push()
    TRY(resize(size));
    for (size_t i = 0; i < size; ++i) data_[i] = kept;
    return {};
  }

  Status copy(Span<const T> source) {
    TRY(resize(source.size()));
    if (size_ != 0) std::memcpy(data_, source.data(), size_ * sizeof(T));
    return {};
  }

  Status push(const T& value) {
    if (size_ == room_) {
      const T kept = value;  // value may live in the memory that reserve() gives back
      TRY(reserve(room_ < 8 ? 8 : room_ + room_ / 2));
      data_[size_++] = kept;
      return {};
    }
    data_[size_++] = value;
    return {};
  }

  // For loops whose room was reserved before.
  void push_reserved(const T& value) {
    WIRESKIN_ASSERT(size_ < room_);
    data_[size_++] = value;
  }

  void pop() {
    WIRESKIN_ASSERT(size_ > 0);
    --size_;
  }
  // Keeps the memory.
  void shrink(size_t size) {
    WIRESKIN_ASSERT(size <= size_);
    size_ = size;
  }
  void clear() { size_ = 0; }
  // Gives the memory back.
  void free() {
    context_->release(data_, room_, sizeof(T));
    data_ = nullptr;
    size_ = room_ = 0;
  }

  T* data() { return data_; }
  const T* data() const { return data_; }
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  // What free() would give back.
  size_t capacity_bytes() const { return room_ * sizeof(T); }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  T& back() { return (*this)[size_ - 1]; }
  const T& back() const { return (*this)[size_ - 1]; }
  T& operator[](size_t i) {
    WIRESKIN_ASSERT(i < size_);
    return data_[i];
  }
  const T& operator[](size_t i) const {
    WIRESKIN_ASSERT(i < size_);
    return data_[i];
  }
  Span<T> span() { return {data_, size_}; }
  Span<const T> span() const { return {data_, size_}; }
  Context& context() const { return *context_; }

 private:
  void forget() {
    data_ = nullptr;
    size_ = room_ = 0;
  }

  Context* context_;
  T* data_ = nullptr;
  size_t size_ = 0;
  size_t room_ = 0;
};

// Prefix sums in place: counts[0 .. n) become the start of each group, counts[n] the total. The
// array has n + 1 elements, the last of which is ignored on entry. Returns the total.
inline uint32_t starts_from_counts(Span<uint32_t> counts) {
  uint32_t sum = 0;
  for (uint32_t& c : counts) {
    const uint32_t count = c;
    c = sum;
    sum += count;
  }
  return counts.empty() ? 0 : counts[counts.size() - 1];
}

// Undoes what filling does to starts: when each group has moved its start to its own end, which is
// the next group's start, every start goes back by one group.
inline void shift_starts_back(Span<uint32_t> starts) {
  for (size_t i = starts.size(); i > 1; --i) starts[i - 1] = starts[i - 2];
  if (!starts.empty()) starts[0] = 0;
}

}  // namespace wireskin
