// SPDX-License-Identifier: MIT
// Laws with branches, for numbers and jets; branches.cmake names the one that is recorded too. Only select can be.
#include "jetlag/tape/recording.hpp"

template <class T>
T by_select(T x) {
  return jetlag::select(x > 0.0 && !(x > 1.0), x, T(0.0));
}

template <class T>
T by_if(T x) {
  if (x > 0.0) x = x + 1.0;
  return x;
}

template <class T>
T by_while(T x) {
  while (x > 0.0) x = x - 1.0;
  return x;
}

template <class T>
T by_conditional(T x) {
  return x > 0.0 ? x : T(0.0);
}

template <class T>
T by_and_with_bool(T x) {
  const bool also = true;
  return jetlag::select(x > 0.0 && also, x, T(0.0));
}

template <class T>
T all(const T& x) {
  return by_select(x) + by_if(x) + by_while(x) + by_conditional(x) + by_and_with_bool(x);
}

double of_numbers(double x) { return all(x); }
jetlag::Jet<double, 3> of_jets(const jetlag::Jet<double, 3>& x) { return all(x); }
jetlag::Recorded of_recorded_values(const jetlag::Recorded& x) { return RECORDED(x); }
