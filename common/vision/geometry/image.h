#pragma once

#include <cstddef>
#include <vector>

namespace puck {

/// Borrows a rectangle of pixels, row by row; `stride` is the distance between rows in elements.
template <typename T>
class ImageView {
 public:
  ImageView() = default;
  ImageView(T* data, int width, int height, std::ptrdiff_t stride)
      : data_(data), width_(width), height_(height), stride_(stride) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return width_ <= 0 || height_ <= 0; }
  T* row(int y) const { return data_ + y * stride_; }
  T& operator()(int x, int y) const { return row(y)[x]; }

  /// The part that begins at (x, y); it must lie inside.
  ImageView part(int x, int y, int width, int height) const {
    return {data_ + y * stride_ + x, width, height, stride_};
  }

 private:
  T* data_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  std::ptrdiff_t stride_ = 0;
};

/// Owns a rectangle of pixels. `resize` keeps the memory it has, so that a loop over regions of
/// changing size stops allocating once the largest has been seen.
template <typename T>
class Image {
 public:
  Image() = default;
  Image(int width, int height) { resize(width, height); }

  void resize(int width, int height) {
    width_ = width;
    height_ = height;
    data_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }
  void reserve(int width, int height) {
    data_.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }

  int width() const { return width_; }
  int height() const { return height_; }
  T* row(int y) { return data_.data() + static_cast<std::ptrdiff_t>(y) * width_; }
  const T* row(int y) const { return data_.data() + static_cast<std::ptrdiff_t>(y) * width_; }
  T& operator()(int x, int y) { return row(y)[x]; }
  const T& operator()(int x, int y) const { return row(y)[x]; }

  ImageView<const T> view() const { return {data_.data(), width_, height_, width_}; }
  ImageView<T> mutable_view() { return {data_.data(), width_, height_, width_}; }

 private:
  std::vector<T> data_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace puck
