// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <exception>
#include <functional>
#include <iostream>

namespace test {

// Another process, which runs a function and is killed at the end if it has not ended. Started while no store is open
// here: a database must not be carried over a fork.
class Child {
 public:
  explicit Child(const std::function<void()>& body) {
    if (pipe(up_) != 0 || pipe(down_) != 0) return;
    pid_ = fork();
    if (pid_ != 0) return;
    int code = 0;
    try {
      current() = this;
      body();
    } catch (const std::exception& error) {
      std::cerr << "child: " << error.what() << std::endl;
      code = 1;
    }
    _exit(code);
  }
  ~Child() {
    kill();
    for (const int fd : {up_[0], up_[1], down_[0], down_[1]}) close(fd);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // In the child: reports that it has come so far, and waits until it may go on.
  static void tell() { (void)!::write(current()->up_[1], "x", 1); }
  static void wait_for_go() {
    char byte;
    (void)!::read(current()->down_[0], &byte, 1);
  }
  // In the parent.
  void wait_told() {
    char byte;
    (void)!::read(up_[0], &byte, 1);
  }
  void go() { (void)!::write(down_[1], "x", 1); }
  void kill() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    join();
  }
  // The exit code, or -1 for a child that was killed.
  int join() {
    if (pid_ <= 0) return code_;
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  static Child*& current() {
    static Child* child = nullptr;
    return child;
  }
  int up_[2] = {-1, -1}, down_[2] = {-1, -1};
  pid_t pid_ = 0;
  int code_ = -1;
};

}  // namespace test
