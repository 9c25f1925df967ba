# stanford_arm.jl – RRP arm plus spherical wrist
#
# DH (standard):
# joint │  θ   │ d   │ a │  α
#   1   │  θ1  │ d1  │ 0 │ -π/2
#   2   │  θ2  │ d2  │ 0 │  π/2
#   3   │  0   │ d3  │ 0 │  0      (prismatic, d3 > 0)
#   4   │  θ4  │ 0   │ 0 │ -π/2
#   5   │  θ5  │ 0   │ 0 │  π/2
#   6   │  θ6  │ d6  │ 0 │  0

using LinearAlgebra

const d1 = 0.40; const d2 = 0.15; const d6 = 0.20

function arm(θ1, θ2, d3)
    s1, c1 = sincos(θ1)
    s2, c2 = sincos(θ2)
    A1 = [c1  0  -s1  0;
          s1  0   c1  0;
          0  -1   0   d1;
          0   0   0   1]
    A2 = [c2  0   s2  0;
          s2  0  -c1  0;
          0   1   0   d2;
          0   0   0   1]
    A3 = [1  0  0  0;
          0  1  0  0;
          0  0  1  d3;
          0  0  0  1]
    return A1 * A2 * A3
end

function wrist(θ4, θ5, θ6)
    s4, c4 = sincos(θ4); s5, c5 = sincos(θ5); s6, c6 = sincos(θ6)
    # orientation of the hand relative to frame 3
    R36 = [c4*c5*c6-s4*s6  -c4*c5*s6-s4*c6   c4*s5;
           s4*c5*c6+c4*s6  -s4*c5*s6+c4*c6   s4*s5;
          -s5*c6            s5*s6            c5]
    return R36
end

"Wrist centre without matrices."
function wristcentre(θ1, θ2, d3)
    s1, c1 = sincos(θ1); s2, c2 = sincos(θ2)
    x = d3*c1*s2 - d2*s1
    y = d3*s1*s2 + d2*c1
    z = d1 + d3*c2
    return [x, y, z]
end

"First three joints for a wrist centre w = p - d6*R[:,3]; θ2 between 0 and π."
function ik_arm(w)
    k  = sqrt(w[1]^2 + w[2]^2 - d2^2)
    θ1 = atan(w[2], w[1]) - atan(d2, k)
    θ2 = atan(k, w[3] - d1)
    d3 = sqrt(w[1]^2 + w[2]^2 - d2^2 + (w[3] - d1)^2)
    return θ1, θ2, d3
end

"Wrist angles from R = R36, branch 0 < θ5 < π."
function ik_wrist(R)
    θ5 = atan(sqrt(R[1,3]^2 + R[2,3]^2), R[3,3])
    θ4 = atan(R[1,3], R[2,3])
    θ6 = atan(R[3,2], -R[3,1])
    return θ4, θ5, θ6
end

# velocity of the wrist centre with respect to (θ1, θ2, d3)
function Jwrist(θ1, θ2, d3)
    s1, c1 = sincos(θ1); s2, c2 = sincos(θ2)
    Jw = [-d3*s1*s2-d2*c1   d3*c1*c2   c1*s2;
           d3*c1*s2-d2*s1   d3*s1*c2   s1*s2;
           0                -d3*s2      c2]
    return Jw
end

detJ(θ2, d3) = -d3^2 * sin(θ2)
