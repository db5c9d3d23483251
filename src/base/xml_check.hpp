#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

// A strict little reader of XML without declarations, comments and CDATA, for tests.
namespace linewright::test {

class XmlCheck {
 public:
  /// What is wrong with the document, or empty.
  static std::string fault(std::string_view text) {
    XmlCheck check(text);
    return check.document();
  }

 private:
  explicit XmlCheck(std::string_view text) : text_(text) {}

  std::string document() {
    while (at_ < text_.size() && fault_.empty()) {
      if (text_[at_] == '<') {
        tag();
      } else {
        words("<");
      }
    }
    if (fault_.empty() && !open_.empty()) say("never closed: " + open_.back());
    if (fault_.empty() && roots_ != 1) say("not one root");
    return fault_;
  }

  void say(const std::string& what) {
    if (fault_.empty()) fault_ = what + " at byte " + std::to_string(at_);
  }

  /// Reads text up to one of `ends`.
  void words(std::string_view ends) {
    for (; at_ < text_.size() && ends.find(text_[at_]) == std::string_view::npos; ++at_) {
      const char c = text_[at_];
      if (open_.empty() && c != '\n' && c != ' ') return say("text outside the root");
      if (c == '<') return say("bare <");
      if (static_cast<unsigned char>(c) < 0x20U && c != '\n') return say("control character");
      if (c == '&' && !entity()) return say("bare &");
    }
  }

  [[nodiscard]] bool entity() const {
    for (const std::string_view known : {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"}) {
      if (text_.substr(at_, known.size()) == known) return true;
    }
    return false;
  }

  std::string name() {
    const std::size_t begin = at_;
    const auto part = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
             c == '-' || c == ':';
    };
    while (at_ < text_.size() && part(text_[at_])) ++at_;
    if (at_ == begin) say("no name");
    return std::string(text_.substr(begin, at_ - begin));
  }

  bool take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  void tag() {
    ++at_;
    if (take('/')) {
      const std::string closed = name();
      if (open_.empty() || open_.back() != closed) return say("closes " + closed);
      open_.pop_back();
      if (!take('>')) say("no >");
      return;
    }
    const std::string opened = name();
    if (open_.empty()) ++roots_;
    open_.push_back(opened);
    attributes();
    if (take('/')) open_.pop_back();
    if (!take('>')) say("no > after " + opened);
  }

  void attributes() {
    std::set<std::string> seen;
    while (take(' ')) {
      if (!seen.insert(name()).second) return say("attribute twice");
      if (!take('=') || !take('"')) return say("attribute without quotes");
      words("\"");
      if (!take('"')) return say("quotes never closed");
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::string> open_;
  int roots_ = 0;
  std::string fault_;
};

}  // namespace linewright::test
