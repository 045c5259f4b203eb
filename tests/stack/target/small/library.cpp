// SPDX-License-Identifier: Apache-2.0
// Functions of the C++ library that the headers of libstdc++ need in these tests: memory allocation, the trees of
// std::map and std::set, and functions that end the program instead of throwing an exception. Also what ends the
// program when an invariant of the stack is violated.
#include <co_assert.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <new>
#include <string>
#include <utility>

#include "program.hpp"

namespace {

[[noreturn]] void give_up(const char* why) {
  board::print(why);
  board::print("\n");
  board::leave(98);
}

}  // namespace

void COAssertFailed(const char* condition, const char* file, int) {
  board::print(file);
  board::print(": an invariant of the stack is violated: ");
  give_up(condition);
}

void* operator new(std::size_t size) {
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) {
    give_up("out of memory");
  }
  return memory;
}

void* operator new[](std::size_t size) { return operator new(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

// Instantiates the string members, which are otherwise in the library.
template class std::basic_string<char>;

namespace std {

int uncaught_exceptions() noexcept { return 0; }

void __throw_bad_alloc() { give_up("std::bad_alloc"); }
void __throw_bad_array_new_length() { give_up("std::bad_array_new_length"); }
void __throw_bad_function_call() { give_up("std::bad_function_call"); }
void __throw_invalid_argument(const char* why) { give_up(why); }
void __throw_length_error(const char* why) { give_up(why); }
void __throw_logic_error(const char* why) { give_up(why); }
void __throw_out_of_range(const char* why) { give_up(why); }
void __throw_out_of_range_fmt(const char* why, ...) { give_up(why); }

namespace {

using Node = _Rb_tree_node_base;

bool is_red(const Node* node) { return node != nullptr && node->_M_color == _S_red; }

// Returns the pointer that refers to \a node: in its parent, or in the header.
Node*& hold_of(Node* node, Node& header) {
  if (node == header._M_parent) {
    return header._M_parent;
  }
  return node == node->_M_parent->_M_left ? node->_M_parent->_M_left : node->_M_parent->_M_right;
}

// Rotates \a child to the position of its parent, which becomes its child.
void rotate_up(Node* child, Node& header) {
  Node* const parent = child->_M_parent;
  const bool left = child == parent->_M_left;
  Node*& inner = left ? child->_M_right : child->_M_left;
  (left ? parent->_M_left : parent->_M_right) = inner;
  if (inner != nullptr) {
    inner->_M_parent = parent;
  }
  hold_of(parent, header) = child;
  child->_M_parent = parent->_M_parent;
  inner = parent;
  parent->_M_parent = child;
}

Node* outermost(Node* node, Node* Node::*side) {
  while (node->*side != nullptr) {
    node = node->*side;
  }
  return node;
}

void hang(Node* node, bool left, Node* parent, Node& header) {
  node->_M_parent = parent;
  node->_M_left = nullptr;
  node->_M_right = nullptr;
  node->_M_color = _S_red;
  if (parent == &header) {
    header._M_parent = header._M_left = header._M_right = node;
  } else if (left) {
    parent->_M_left = node;
    header._M_left = parent == header._M_left ? node : header._M_left;
  } else {
    parent->_M_right = node;
    header._M_right = parent == header._M_right ? node : header._M_right;
  }
}

// Replaces \a node by \a by, a node of its sub-tree or null.
void replace(Node* node, Node* by, Node& header) {
  hold_of(node, header) = by;
  if (by != nullptr) {
    by->_M_parent = node->_M_parent;
  }
}

const Node* next_of(const Node* node, Node* Node::*towards, Node* Node::*away) {
  if (node->*towards != nullptr) {
    return outermost(node->*towards, away);
  }
  const Node* parent = node->_M_parent;
  while (node == parent->*towards) {
    node = parent;
    parent = parent->_M_parent;
  }
  return node->*towards == parent ? node : parent;  // the header, if the root has no sub-tree on that side
}

}  // namespace

Node* _Rb_tree_increment(Node* node) throw() {
  return const_cast<Node*>(_Rb_tree_increment(const_cast<const Node*>(node)));
}
const Node* _Rb_tree_increment(const Node* node) throw() { return next_of(node, &Node::_M_right, &Node::_M_left); }
Node* _Rb_tree_decrement(Node* node) throw() {
  return const_cast<Node*>(_Rb_tree_decrement(const_cast<const Node*>(node)));
}
const Node* _Rb_tree_decrement(const Node* node) throw() {
  const bool is_header = is_red(node) && node->_M_parent->_M_parent == node;
  return is_header ? node->_M_right : next_of(node, &Node::_M_left, &Node::_M_right);
}

void _Rb_tree_insert_and_rebalance(const bool left, Node* node, Node* parent, Node& header) throw() {
  hang(node, left, parent, header);
  while (node != header._M_parent && is_red(node->_M_parent)) {
    Node* const upper = node->_M_parent;
    Node* const top = upper->_M_parent;
    Node* const other = upper == top->_M_left ? top->_M_right : top->_M_left;
    if (is_red(other)) {
      upper->_M_color = other->_M_color = _S_black;
      top->_M_color = _S_red;
      node = top;
      continue;
    }
    const bool inside = (node == upper->_M_left) != (upper == top->_M_left);
    Node* const middle = inside ? node : upper;
    if (inside) {
      rotate_up(node, header);
    }
    rotate_up(middle, header);
    middle->_M_color = _S_black;
    top->_M_color = _S_red;
    break;
  }
  header._M_parent->_M_color = _S_black;
}

// Removes a node without balancing: the trees of the tests grow and rarely shrink.
Node* _Rb_tree_rebalance_for_erase(Node* const node, Node& header) throw() {
  const Node* const next = node == header._M_right ? &header : _Rb_tree_increment(node);
  const Node* const before = node == header._M_left ? &header : _Rb_tree_decrement(node);
  if (node->_M_left == nullptr || node->_M_right == nullptr) {
    replace(node, node->_M_left == nullptr ? node->_M_right : node->_M_left, header);
  } else {
    Node* const heir = const_cast<Node*>(next);
    replace(heir, heir->_M_right, header);
    replace(node, heir, header);
    heir->_M_left = node->_M_left;
    heir->_M_right = node->_M_right;
    heir->_M_color = node->_M_color;
    heir->_M_left->_M_parent = heir;
    if (heir->_M_right != nullptr) {
      heir->_M_right->_M_parent = heir;
    }
  }
  header._M_left = node == header._M_left ? const_cast<Node*>(next) : header._M_left;
  header._M_right = node == header._M_right ? const_cast<Node*>(before) : header._M_right;
  if (header._M_parent != nullptr) {
    header._M_parent->_M_color = _S_black;
  }
  return node;
}

}  // namespace std
