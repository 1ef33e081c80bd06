# shellcheck shell=bash
# The files that command lines of the documentation name, made of the project's own; to be sourced.

# make_user_files SOURCE FOLDER: what a user would have: a mesh, a part of a CAD program, a scan, a glTF file.
make_user_files() {
    local source=$1 folder=$2
    cp -r "$source/scenes" "$folder/scenes"  # a scene names no file outside of its folder, by a link neither
    cp "$source/scenes/meshes/goblet.obj" "$folder/mesh.obj"
    cp "$source/scenes/meshes/knot.obj" "$folder/scan.obj"
    # A wheel of 20 teeth in millimetres: z up, standing on z = 0, flat faces.
    awk 'BEGIN {
        n = 160; pi = 3.14159265358979
        for (k = 0; k < n; ++k) {
            tooth = k % 8; r = tooth < 3 ? 40 : tooth == 3 || tooth == 7 ? 37 : 34
            a = 2 * pi * k / n
            for (z = 0; z <= 12; z += 12) printf "v %.4f %.4f %d\nv %.4f %.4f %d\n", r * cos(a), r * sin(a), z, 14 * cos(a), 14 * sin(a), z
        }
        for (k = 0; k < n; ++k) {
            i = 4 * k; j = 4 * ((k + 1) % n)
            printf "f %d %d %d %d\n", i + 1, j + 1, j + 3, i + 3   # outside
            printf "f %d %d %d %d\n", j + 2, i + 2, i + 4, j + 4   # bore
            printf "f %d %d %d %d\n", i + 3, j + 3, j + 4, i + 4   # top
            printf "f %d %d %d %d\n", j + 1, i + 1, i + 2, j + 2   # bottom
        }
    }' >"$folder/part.obj"
    # The shell with colours of its vertices, without normals, as scanners write.
    awk '
        $1 == "v" { x[n] = $2; y[n] = $3; z[n] = $4; ++n }
        $1 == "f" {
            sub(/^f +/, ""); gsub(/\/[0-9]*/, "")
            k = split($0, at, " ")
            face[m] = k
            for (i = 1; i <= k; ++i) face[m] = face[m] " " at[i] - 1
            ++m
        }
        END {
            print "ply\nformat ascii 1.0\nelement vertex " n "\nproperty float x\nproperty float y\nproperty float z"
            print "property uchar red\nproperty uchar green\nproperty uchar blue"
            print "element face " m "\nproperty list uchar int vertex_indices\nend_header"
            for (i = 0; i < n; ++i) {
                t = 0.5 + 0.5 * sin(9 * y[i] + 3 * sin(4 * x[i]))
                printf "%s %s %s %d %d %d\n", x[i], y[i], z[i], 120 + 110 * t, 90 + 70 * t, 70 + 30 * t
            }
            for (i = 0; i < m; ++i) print face[i]
        }' n=0 m=0 "$source/scenes/meshes/shell.obj" >"$folder/scan.ply"
    cp "$folder/scan.ply" "$folder/big.ply"
    cp "$folder/scan.obj" "$folder/bunny.obj"
    make_gltf "$source/scenes/meshes/vase.obj" "$folder/product"
    cp "$folder/product.glb" "$folder/scene.glb"
    cp "$folder/product.glb" "$folder/many.glb"
}

# make_gltf OBJ NAME: NAME.glb, with the positions, normals and faces of the file, as lacquered copper.
make_gltf() {
    perl -e '
        my ($from, $to) = @ARGV;
        my (@v, @n, %seen, @out, @index);
        open(my $in, "<", $from) or die;
        while (<$in>) {
            my @w = split;
            next unless @w;
            if ($w[0] eq "v") { push @v, [@w[1 .. 3]] }
            elsif ($w[0] eq "vn") { push @n, [@w[1 .. 3]] }
            elsif ($w[0] eq "f") {
                my @corner = map {
                    my ($p, undef, $m) = split /\//;
                    $p += $p < 0 ? @v : -1;
                    $m += $m < 0 ? @n : -1;
                    $seen{"$p/$m"} //= do { push @out, [@{$v[$p]}, @{$n[$m]}]; $#out };
                } @w[1 .. $#w];
                push @index, $corner[0], $corner[$_], $corner[$_ + 1] for 1 .. $#corner - 1;
            }
        }
        my (@low, @high);
        for my $k (0 .. 2) {
            my @of = sort { $a <=> $b } map { $_->[$k] } @out;
            ($low[$k], $high[$k]) = @of[0, -1];
        }
        my $positions = pack("f<*", map { @$_[0 .. 2] } @out);
        my $normals = pack("f<*", map { @$_[3 .. 5] } @out);
        my $indices = pack("V*", @index);
        my $bytes = length $positions;
        my $json = sprintf(q({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],) .
            q("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1},"indices":2,"material":0}]}],) .
            q("materials":[{"name":"copper","pbrMetallicRoughness":{"baseColorFactor":[0.9,0.42,0.25,1],"metallicFactor":1,"roughnessFactor":0.35}}],) .
            q("accessors":[{"bufferView":0,"componentType":5126,"count":%d,"type":"VEC3","min":[%s],"max":[%s]},) .
            q({"bufferView":1,"componentType":5126,"count":%d,"type":"VEC3"},{"bufferView":2,"componentType":5125,"count":%d,"type":"SCALAR"}],) .
            q("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":%d},{"buffer":0,"byteOffset":%d,"byteLength":%d},{"buffer":0,"byteOffset":%d,"byteLength":%d}],) .
            q("buffers":[{"byteLength":%d}]}),
            scalar(@out), join(",", @low), join(",", @high), scalar(@out), scalar(@index),
            $bytes, $bytes, $bytes, 2 * $bytes, length $indices, 2 * $bytes + length $indices);
        $json .= " " while length($json) % 4;
        my $data = $positions . $normals . $indices;
        open(my $file, ">:raw", "$to.glb") or die;
        print $file "glTF", pack("VV", 2, 28 + length($json) + length $data), pack("V", length $json), "JSON", $json,
            pack("V", length $data), "BIN\0", $data;' "$1" "$2"
}

# make_scenes FOLDER: scene files and studies of the names that pages use, all small.
make_scenes() {
    local folder=$1 number
    cat >"$folder/scene.toml" <<'END'
version = 1
[camera]
position = [0, 3, 9]
target = [0, 1, 0]
[camera.close]
fov = 12
[camera.front]
position = [0, 2, 9]
[camera.door]
position = [6, 2, 6]
[camera.window]
position = [-6, 2, 6]
[[light]]
type = "environment"
file = "scenes/textures/evening_fish_eye.png"
[[light]]
type = "sphere"
center = [3, 5, 4]
radius = 1
radiance = 8
[[mesh]]
file = "scenes/meshes/mug.obj"
scale = 0.2
material = "glass"
[[sphere]]
center = [2, 1, 0]
material = "floor"
[[plane]]
material = "ground"
[material.floor]
type = "plastic"
[material.glass]
type = "glass"
[material.ground]
base_color = 0.4
shadow_catcher = true
[animation]
frames = [1, 3]
[[animation.track]]
key = "mesh.0.rotate"
frames = [1, 4]
values = [[0, 0, 0], [0, 360, 0]]
END
    sed '/^\[animation\]/,$d' "$folder/scene.toml" >"$folder/room.toml"
    cp "$folder/room.toml" "$folder/a.toml"
    for number in 0001 0002; do cp "$folder/room.toml" "$folder/scene.$number.toml"; done
    mkdir -p "$folder/build/rooms" "$folder/bench/studies" "$folder/shared"
    sed 's#"scenes/#"../../scenes/#' "$folder/room.toml" >"$folder/build/rooms/sponza-sun.toml"
    printf 'mtllib bottle.mtl\nusemtl green_glass\n' | cat - "$folder/scenes/meshes/bottle.obj" >"$folder/bottle.obj"
    printf 'newmtl green_glass\nKd 0.35 0.6 0.4\nKs 0.5 0.5 0.5\nNs 250\nillum 2\n' >"$folder/bottle.mtl"
    cat >"$folder/study.toml" <<'END'
version = 1
seeds = 2
spp = 2
[[scene]]
name = "cornell"
file = "scenes/cornell.toml"
options = "--size 16x9"
reference_spp = 16
[[method]]
name = "path"
[[method]]
name = "independent"
options = "--sampler independent"
END
    for number in ladder anchors rooms slopes whitted; do
        sed 's#scenes/cornell#../../scenes/cornell#' "$folder/study.toml" >"$folder/bench/studies/$number.toml"
    done
}
