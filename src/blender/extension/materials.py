"""What of a material can be given to the simplifier, which knows the Principled BSDF of glTF files."""

# Nodes between an image and an input of the shader. MIX and MATH may only multiply, which glTF has as factors.
_PASSING = {"TEX_IMAGE", "NORMAL_MAP", "SEPARATE_COLOR", "UVMAP", "MAPPING", "TEX_COORD", "VERTEX_COLOR", "RGB", "VALUE",
            "REROUTE"}
_ROUNDING = {"ROUND", "LESS_THAN", "GREATER_THAN", "SUBTRACT"}  # of alpha


def _nodes_before(socket):
    """Returns all nodes that a socket depends on."""
    found, waiting = [], [link.from_node for link in socket.links]
    while waiting:
        node = waiting.pop()
        if node not in found:
            found.append(node)
            waiting += [link.from_node for before in node.inputs for link in before.links]
    return found


def _node_fault(node, socket):
    """Returns what is wrong with a node before a socket of the shader, or None."""
    if node.type == "TEX_IMAGE":
        image = node.image
        if image is None:
            return f"node '{node.name}' has no image"
        if image.source not in ("FILE", "GENERATED"):
            return f"image '{image.name}' is of the kind {image.source.lower()}, only single images can be read"
        if 0 in image.size:
            return f"image '{image.name}' is missing or damaged ({image.filepath})"
    elif node.type == "MIX":
        if node.data_type != "RGBA" or node.blend_type != "MULTIPLY":
            return f"node '{node.name}' before {socket.name} mixes colours other than by Multiply; bake them to one image"
    elif node.type == "MATH":
        if node.operation != "MULTIPLY" and not (socket.name == "Alpha" and node.operation in _ROUNDING):
            return f"node '{node.name}' before {socket.name} is {node.operation}, only Multiply can be read"
    elif node.type not in _PASSING:
        return f"node '{node.name}' before {socket.name} cannot be read; bake it to an image"
    return None


def material_fault(material, has_uvs):
    """Returns why new textures cannot be made from a material, or None."""
    tree = material.node_tree
    output = tree and tree.get_output_node("ALL")
    if not output:
        return None
    shaders = [node for node in _nodes_before(output.inputs["Surface"]) if node.type != "REROUTE"]
    principled = [node for node in shaders if node.type == "BSDF_PRINCIPLED"]
    if len(principled) != 1 or output.inputs["Surface"].links[0].from_node.type not in ("BSDF_PRINCIPLED", "REROUTE"):
        return "its surface is not one Principled BSDF"
    for socket in principled[0].inputs:
        nodes = _nodes_before(socket)
        images = [node for node in nodes if node.type == "TEX_IMAGE"]
        if images and not has_uvs:
            return f"image '{images[0].image and images[0].image.name}' needs a UV map, and the mesh has none"
        if len(images) > 1:
            return f"{socket.name} has {len(images)} images; bake them to one"
        for fault in (_node_fault(node, socket) for node in nodes):
            if fault:
                return fault
    return None
