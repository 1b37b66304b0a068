#pragma once
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace turnwright::service {

/// A client that may misbehave: it sends bytes and reads until the server closes or
/// pauses.
class RawClient {
 public:
  explicit RawClient(std::uint16_t port) : fd_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{120, 0};  // a loaded machine is no fault
    ::setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (::connect(fd_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0)
      throw std::runtime_error("no connection");
  }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;
  ~RawClient() { ::close(fd_); }

  void send(const std::string& bytes) const {
    for (std::size_t at = 0; at < bytes.size();) {
      const auto n = ::send(fd_, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
      if (n <= 0) return;  // the server has closed; what it said can still be read
      at += static_cast<std::size_t>(n);
    }
  }

  /// Everything until the server closes; throws if it neither sends nor closes in time.
  std::string rest() const {
    std::string all;
    while (more(all)) {
    }
    return all;
  }

  /// One answer with a Content-Length.
  std::string answer() {
    std::size_t head = 0;
    while ((head = seen_.find("\r\n\r\n")) == std::string::npos)
      if (!more(seen_)) throw std::runtime_error("closed: " + seen_);
    const auto field = seen_.find("Content-Length: ");
    const auto length = field < head ? std::stoul(seen_.substr(field + 16)) : 0;
    while (seen_.size() < head + 4 + length)
      if (!more(seen_)) throw std::runtime_error("closed in the body");
    std::string one = seen_.substr(0, head + 4 + length);
    seen_.erase(0, one.size());
    return one;
  }

  std::string ask(const std::string& bytes) {
    send(bytes);
    return answer();
  }

 private:
  bool more(std::string& to) const {
    char part[65536];
    const auto n = ::recv(fd_, part, sizeof part, 0);
    if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
      throw std::runtime_error("the server is silent");
    if (n <= 0) return false;
    to.append(part, static_cast<std::size_t>(n));
    return true;
  }

  int fd_;
  std::string seen_;
};

inline int status_of(const std::string& answer) { return std::stoi(answer.substr(9, 3)); }
inline std::string body_of(const std::string& answer) {
  return answer.substr(answer.find("\r\n\r\n") + 4);
}

}  // namespace turnwright::service
