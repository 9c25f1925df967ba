"""Compiles @name@.cu at run time (NVRTC) and holds the kernels to the stored configurations.

Needs the NVRTC library (the CUDA toolkit, or `pip install nvidia-cuda-nvrtc-cu12`) and, to run, a
GPU with its driver. Ends with 0 if all agree, 1 if not, 77 if the code compiles but there is no
GPU.
"""

import ctypes
import ctypes.util
import glob
import os
import sys
import sysconfig

FOLDER = os.path.dirname(os.path.abspath(__file__))
REAL = ctypes.@ctype@
EPSILON = @epsilon@
COUNT = 1000  # enough for several thread blocks, the last one not full


def library(names):
    """The first of several libraries that is there."""
    for name in names:
        try:
            return ctypes.CDLL(name)
        except OSError:
            continue
    return None


def nvrtc():
    site = sysconfig.get_paths()["purelib"]
    packaged = sorted(glob.glob(os.path.join(site, "nvidia", "*", "lib", "libnvrtc.so*")))
    found = ctypes.util.find_library("nvrtc")
    return library([found] * bool(found) + ["libnvrtc.so.13", "libnvrtc.so.12"] + packaged)


def compiled(compiler, architecture):
    """The PTX of the kernels."""

    def read(name):
        with open(os.path.join(FOLDER, name), "rb") as file:
            return file.read()

    program = ctypes.c_void_p()
    source = read("@name@.cu")
    headers = (ctypes.c_char_p * 1)(read("@name@.cuh"))
    names = (ctypes.c_char_p * 1)(b"@name@.cuh")
    status = compiler.nvrtcCreateProgram(
        ctypes.byref(program), source, b"@name@.cu", 1, headers, names
    )
    assert status == 0, f"nvrtcCreateProgram: {status}"
    options = [f"--gpu-architecture=compute_{architecture}".encode(), b"--std=c++14"]
    status = compiler.nvrtcCompileProgram(program, 2, (ctypes.c_char_p * 2)(*options))
    size = ctypes.c_size_t()
    compiler.nvrtcGetProgramLogSize(program, ctypes.byref(size))
    log = ctypes.create_string_buffer(size.value)
    compiler.nvrtcGetProgramLog(program, log)
    if log.value.strip():
        print(log.value.decode())
    if status != 0 or b"warning" in log.value:
        sys.exit(1)
    compiler.nvrtcGetPTXSize(program, ctypes.byref(size))
    ptx = ctypes.create_string_buffer(size.value)
    compiler.nvrtcGetPTX(program, ptx)
    return ptx.raw


class Gpu:
    """The first device, through the driver."""

    def __init__(self):
        self.driver = library(["libcuda.so.1", "libcuda.so"])
        count, device = ctypes.c_int(), ctypes.c_int()
        self.here = (
            self.driver is not None
            and self.driver.cuInit(0) == 0
            and self.driver.cuDeviceGetCount(ctypes.byref(count)) == 0
            and count.value > 0
        )
        if not self.here:
            return
        self.call("cuDeviceGet", ctypes.byref(device), 0)
        version = [ctypes.c_int(), ctypes.c_int()]
        for attribute, value in zip((75, 76), version):
            self.call("cuDeviceGetAttribute", ctypes.byref(value), attribute, device)
        self.architecture = 10 * version[0].value + version[1].value
        self.context, self.module = ctypes.c_void_p(), ctypes.c_void_p()
        self.call("cuDevicePrimaryCtxRetain", ctypes.byref(self.context), device)
        self.call("cuCtxSetCurrent", self.context)

    def call(self, name, *arguments):
        status = getattr(self.driver, name)(*arguments)
        assert status == 0, f"{name}: {status}"

    def load(self, ptx):
        self.call("cuModuleLoadData", ctypes.byref(self.module), ptx)

    def run(self, kernel, q, parameters, results):
        """The results of COUNT configurations, side by side like q."""
        function, pointers = ctypes.c_void_p(), []
        self.call("cuModuleGetFunction", ctypes.byref(function), self.module, kernel.encode())
        values = (REAL * results)()
        for array in (q, values):
            size = ctypes.c_size_t(ctypes.sizeof(array))
            pointers.append(ctypes.c_uint64())
            self.call("cuMemAlloc_v2", ctypes.byref(pointers[-1]), size)
        size = ctypes.c_size_t(ctypes.sizeof(q))
        self.call("cuMemcpyHtoD_v2", pointers[0], ctypes.byref(q), size)
        given = [(REAL * len(parameters))(*parameters)] if parameters else []
        arguments = [ctypes.c_size_t(COUNT), pointers[0], *given, pointers[1]]
        addresses = [ctypes.cast(ctypes.byref(a), ctypes.c_void_p) for a in arguments]
        array = (ctypes.c_void_p * len(addresses))(*addresses)
        blocks = (COUNT + 255) // 256
        self.call("cuLaunchKernel", function, blocks, 1, 1, 256, 1, 1, 0, None, array, None)
        size = ctypes.c_size_t(ctypes.sizeof(values))
        self.call("cuMemcpyDtoH_v2", ctypes.byref(values), pointers[1], size)
        for pointer in pointers:
            self.call("cuMemFree_v2", pointer)
        return values


def tolerance(variables):
    """Units in the last place, of the scale of a result@rounding@."""
    return @units@ * EPSILON


def failures(gpu, function):
    """How many results of a function are wrong."""
    wrong, vectors, scales = 0, function["vectors"], function["scales"]
    for v, (variables, parameters, expected) in enumerate(vectors):
        lanes = [vectors[(v + i) % len(vectors)][0] for i in range(COUNT)]
        values = [lane[j] for j in range(len(variables)) for lane in lanes]
        q = (REAL * max(1, len(values)))(*values)
        values = gpu.run(function["kernel"], q, parameters, len(expected) * COUNT)
        for k, (right, scale) in enumerate(zip(expected, scales)):
            for i in range(0, COUNT, len(vectors)):
                value, allowed = values[k * COUNT + i], tolerance(variables) * scale
                if not abs(value - right) <= allowed:
                    print(f"{function['kernel']}, configuration {v}, result {k}: {value!r},")
                    print(f"  expected {right!r} within {allowed:.2g}")
                    wrong += 1
    return wrong


def main():
    compiler = nvrtc()
    if compiler is None:
        print("NVRTC is not installed: nothing was compiled")
        sys.exit(77)
    gpu = Gpu()
    ptx = compiled(compiler, min(gpu.architecture, 90) if gpu.here else 80)
    if not gpu.here:
        print("@name@.cu compiles; no GPU, so that nothing ran")
        sys.exit(77)
    gpu.load(ptx)
    wrong = sum(failures(gpu, function) for function in FUNCTIONS)
    if wrong == 0:
        print("@name@: all configurations agree")
    sys.exit(wrong != 0)


@tables@

if __name__ == "__main__":
    main()
