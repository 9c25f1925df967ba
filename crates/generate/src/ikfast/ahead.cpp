#ifndef IKFAST_HAS_LIBRARY
#define IKFAST_HAS_LIBRARY
#endif
#include "ikfast.h" /* that of the project which takes this file */

#include <cmath>
#include <vector>
#if !defined(__GNUC__)
#include <cstring>
#endif

using namespace ikfast; /* as IKFast's files have it: those that include them count on it */

#ifdef IKFAST_NAMESPACE
namespace IKFAST_NAMESPACE {
#endif
